// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/linear_check.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "equations/compiled_system.h"
#include "integration/watch_layout.h"
#include "linear/rest_numbers.h"
#include "math/arrays.h"
#include "math/differences.h"
#include "sensitivity/complex_steps.h"

namespace codesign {
namespace {

/// The numbers along a line in the design, each point computed once.
class LinearLine {
 public:
  LinearLine(const CompiledSystem& system, const std::vector<double>& parameters,
             Eigen::VectorXd direction, const std::atomic<bool>* cancel)
      : numbers_(system),
        study_(system.study()),
        parameters_(parameters),
        direction_(std::move(direction)),
        cancel_(cancel) {}

  double at(double step, std::size_t entry, Eigen::Index place) {
    const auto known = values_.find(step);
    const std::vector<Eigen::VectorXd>& all =
        known == values_.end() ? compute(step) : known->second;
    return status_.ok() ? all[entry][place] : 0.0;
  }
  const Status& status() const { return status_; }

 private:
  const std::vector<Eigen::VectorXd>& compute(double step) {
    std::vector<Eigen::VectorXd>& all = values_[step];
    if (!status_.ok()) return all;
    status_ = numbers_.evaluate(moved(study_, parameters_, direction_, step), false, cancel_);
    for (const RestNumbers::Entry& entry : numbers_.entries()) all.push_back(entry.values);
    return all;
  }

  RestNumbers numbers_;
  const MotionStudy& study_;
  const std::vector<double>& parameters_;
  const Eigen::VectorXd direction_;
  const std::atomic<bool>* cancel_;
  std::map<double, std::vector<Eigen::VectorXd>> values_;
  Status status_;
};

}  // namespace

Status add_linear_differences(const CompiledSystem& system, const std::vector<double>& parameters,
                              const Eigen::MatrixXd& directions, const std::atomic<bool>* cancel,
                              Eigen::VectorXd* objective, Eigen::VectorXd* error,
                              Eigen::MatrixXd* watched) {
  const MotionStudy& study = system.study();
  if (!needs_linearization(study)) return {};
  const WatchLayout layout(study);
  if (watched->cols() != layout.size()) watched->setZero(directions.cols(), layout.size());
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    LinearLine line(system, parameters, directions.col(k), cancel);
    const double largest = step_along(study, parameters, directions.col(k), [](double value) {
      return 1e-2 * std::max(std::abs(value), 1e-3);
    });
    std::size_t entry = 0;
    for (std::size_t w = 0; w < study.watched.size(); ++w) {
      if (!study.watched[w].linear) continue;
      const WatchLayout::Entry& places = layout.entries()[w];
      double first_error = 0.0;
      for (int place = 0; place + places.first < places.measure(); ++place) {
        const RiddersDerivative derivative = ridders_derivative(
            [&](double step) { return line.at(step, entry, place); }, 0.0, largest);
        if (!line.status().ok()) return line.status();
        (*watched)(k, places.first + place) = derivative.value;
        if (place == 0) first_error = derivative.error;
      }
      // The places are in the order in which they decide.
      (*watched)(k, places.measure()) = (*watched)(k, places.first);
      if (is_term(study.watched[w])) {
        (*objective)[k] += study.watched[w].weight * (*watched)(k, places.first);
        (*error)[k] += std::abs(study.watched[w].weight) * first_error;
      }
      ++entry;
    }
  }
  return {};
}

}  // namespace codesign
