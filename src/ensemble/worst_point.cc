// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/worst_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "description/study.h"
#include "math/arrays.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kFirstClimb = 0.25, kLastClimb = 1.0 / 128.0;
constexpr std::size_t kMostClimbed = 2000;
// At a minimum of the worst case several samples are the worst: climbs begin at all of them that
// are less than this share better, at most so many.
constexpr double kNearWorst = 0.1;
constexpr std::size_t kMostStarts = 6;

/// A parameter that lies anywhere between two values.
struct Interval {
  int parameter;
  double lower, upper;
};

std::vector<Interval> intervals_of(const Study& study) {
  std::vector<Interval> intervals;
  for (const UncertainQuantity& quantity : study.ensemble.uncertain)
    if (quantity.parameter >= 0 && quantity.distribution.kind == DistributionKind::kUniform)
      intervals.push_back(
          {quantity.parameter, quantity.distribution.lower, quantity.distribution.upper});
  return intervals;
}

double& uncertain_value(int parameter, Scenario* scenario) {
  return std::find_if(scenario->values.begin(), scenario->values.end(),
                      [parameter](const auto& value) { return value.first == parameter; })
      ->second;
}

class Climb {
 public:
  Climb(const Study& study, const Ensemble& ensemble, const Eigen::VectorXd& rho,
        const std::atomic<bool>* cancel)
      : intervals_(intervals_of(study)), ensemble_(ensemble), rho_(rho), cancel_(cancel) {}

  WorstPoint run(const Scenario& from, double objective) {
    result_.objective = objective;
    result_.scenario = from;
    // The nominal values of a single sample are no values of the scenario.
    result_.is_known = !intervals_.empty() && from.sample >= 0;
    for (double step = kFirstClimb; result_.is_known && step >= kLastClimb;)
      if (!take_step(step)) step *= 0.5;
    return std::move(result_);
  }

 private:
  bool take_step(double step) {
    std::vector<Scenario> beside;
    for (const Interval& interval : intervals_)
      for (const double sign : {1.0, -1.0}) {
        beside.push_back(result_.scenario);
        double& value = uncertain_value(interval.parameter, &beside.back());
        value = std::clamp(value + sign * step * (interval.upper - interval.lower), interval.lower,
                           interval.upper);
      }
    const std::vector<double> gains = gains_of(beside);
    Scenario together = result_.scenario;
    int improving = 0;
    for (std::size_t k = 0; k < intervals_.size(); ++k) {
      const std::size_t better = gains[2 * k] >= gains[2 * k + 1] ? 2 * k : 2 * k + 1;
      if (!(gains[better] > 0.0)) continue;
      ++improving;
      const int parameter = intervals_[k].parameter;
      uncertain_value(parameter, &together) = uncertain_value(parameter, &beside[better]);
    }
    const auto best = std::max_element(gains.begin(), gains.end()) - gains.begin();
    double gain = gains[to_index(best)];
    Scenario next = beside[to_index(best)];
    if (improving > 1)
      if (const double of_all = gains_of({together})[0]; of_all > gain) {
        gain = of_all;
        next = std::move(together);
      }
    if (!(gain > 0.0) || !result_.status.ok() || evaluations_ > kMostClimbed) return false;
    result_.scenario = std::move(next);
    result_.objective += gain;
    return true;
  }

  /// By how much the objective at each scenario exceeds the largest so far; negative where it
  /// cannot be integrated.
  std::vector<double> gains_of(const std::vector<Scenario>& scenarios) {
    std::vector<double> gains(scenarios.size(), -1.0);
    if (!result_.status.ok() || evaluations_ > kMostClimbed) return gains;
    const std::vector<Evaluation> members =
        ensemble_.engine().evaluate(tasks_at(scenarios, rho_, Derivatives::kNone), cancel_);
    evaluations_ += members.size();
    for (std::size_t k = 0; k < members.size(); ++k) {
      result_.statistics += members[k].statistics;
      if (members[k].status.is_interrupted()) result_.status = members[k].status;
      if (members[k].status.ok()) gains[k] = members[k].objective - result_.objective;
    }
    return gains;
  }

  const std::vector<Interval> intervals_;
  const Ensemble& ensemble_;
  const Eigen::VectorXd& rho_;
  const std::atomic<bool>* cancel_;
  WorstPoint result_;
  std::size_t evaluations_ = 0;
};

}  // namespace

WorstPoint find_worst_point(const Problem& problem, const Ensemble& ensemble,
                            const Eigen::VectorXd& rho, const Eigen::VectorXd& values,
                            const std::atomic<bool>* cancel) {
  std::vector<Eigen::Index> order(to_index(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return values[a] > values[b]; });
  const double worst = values[order.front()];
  WorstPoint highest;
  Statistics statistics;
  for (std::size_t k = 0; k < order.size() && k < kMostStarts && highest.status.ok(); ++k) {
    const double value = values[order[k]];
    if (value < worst - kNearWorst * std::abs(worst)) break;
    WorstPoint found = Climb(study_of(problem), ensemble, rho, cancel)
                           .run(ensemble.scenarios()[to_index(order[k])], value);
    statistics += found.statistics;
    if (k == 0 || !found.status.ok() || found.objective > highest.objective)
      highest = std::move(found);
  }
  highest.statistics = statistics;
  return highest;
}

}  // namespace codesign
