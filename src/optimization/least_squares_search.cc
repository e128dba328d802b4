// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/least_squares_search.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "optimization/levenberg_marquardt.h"

namespace codesign {
namespace {

/// The objective of an ensemble by the scaled variables of (24).
class EnsembleSquares final : public LeastSquaresModel {
 public:
  EnsembleSquares(SearchTrials* trials, const Scaling& scaling) : trials_(*trials), scaling_(scaling) {}

  Outcome evaluate(const Eigen::VectorXd& x, LeastSquaresPoint* point) override {
    const Eigen::VectorXd rho = scaling_.from_scaled({x.begin(), x.end()});
    const bool is_known = trials_.last_rho().size() == rho.size() && trials_.last_rho() == rho && trials_.last().total.status.ok() &&
                          trials_.last().total.jacobian_root.size() > 0;
    if (!is_known && !trials_.evaluate(rho, Derivatives::kGaussNewton)) return Outcome::kStop;
    const Evaluation& evaluation = trials_.last().total;
    if (!evaluation.status.ok()) return Outcome::kFailed;
    const std::vector<double> gradient = scaling_.scale_gradient(evaluation.gradient);
    point->value = evaluation.objective;
    point->gradient = Eigen::Map<const Eigen::VectorXd>(gradient.data(), x.size());
    point->root = evaluation.jacobian_root;
    for (Eigen::Index k = 0; k < x.size(); ++k) point->root.col(k) *= scaling_.range(static_cast<std::size_t>(k));
    return Outcome::kUsable;
  }

 private:
  SearchTrials& trials_;
  const Scaling& scaling_;
};

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

}  // namespace

void search_squares(const OptimizerOptions& options, const Eigen::VectorXd& start, const Scaling& scaling, SearchTrials* trials) {
  EnsembleSquares squares(trials, scaling);
  const Eigen::VectorXd lower = as_vector(scaling.lower()), upper = as_vector(scaling.upper());
  Eigen::VectorXd x = as_vector(scaling.to_scaled(start)).cwiseMax(lower).cwiseMin(upper);
  LeastSquaresPoint best;
  LevenbergMarquardtOptions search;
  search.max_evaluations = options.max_evaluations - trials->result().evaluations;
  search.relative_tolerance = options.relative_tolerance;
  trials->result().termination = name_of(minimize_squares(search, lower, upper, &squares, &x, &best));
}

}  // namespace codesign
