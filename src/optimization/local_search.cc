// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/local_search.h"

#include <algorithm>
#include <cmath>

#include "description/study.h"
#include "optimization/algorithm.h"
#include "optimization/levenberg_marquardt.h"
#include "optimization/minimization.h"
#include "optimization/scaling.h"
#include "optimization/search_trials.h"
#include "optimization/smooth_program.h"

namespace codesign {
namespace {

constexpr int kMostAttempts = 12;
constexpr double kLeastTolerance = 1e-15;
constexpr double kTighten = 1e-3;  // the tolerance of a restart over that of the attempt before

RobustMeasure measure_of(const Ensemble& ensemble) {
  return ensemble.scenarios().size() > 1 ? ensemble.options().measure : RobustMeasure::kMean;
}

bool has_slack(RobustMeasure measure) {
  return measure == RobustMeasure::kWorst || measure == RobustMeasure::kCvar;
}

/// A search from its start to a stop that can be trusted: where an algorithm stops on a slope, it
/// begins again from there, with fresh memory and a tighter tolerance; where that gains nothing,
/// the next algorithm goes on; doc/theory.md (24j).
class Search {
 public:
  Search(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble,
         const TrialObserver& observer, const std::atomic<bool>* cancel)
      : study_(study),
        options_(options),
        scaling_(study),
        program_(ensemble),
        trials_(study, options, ensemble, observer, cancel, scaling_, &program_),
        algorithms_(algorithms_for(study, options, measure_of(ensemble),
                                   has_slack(measure_of(ensemble)))) {}

  OptimizationResult run(const Eigen::VectorXd& start) {
    trials_.start(start);
    OptimizerOptions attempt = options_;
    std::size_t algorithm = 0;
    for (int k = 0; k < kMostAttempts; ++k) {
      const double before = result_.best.objective, outside = trials_.best_violation();
      const bool had_best = trials_.have_best();
      try_from(had_best ? result_.best.rho : start, algorithms_[algorithm], &attempt);
      if (!goes_on()) break;
      const bool has_gained =
          had_best && (before - result_.best.objective >
                           options_.relative_tolerance * std::abs(result_.best.objective) ||
                       trials_.best_violation() < 0.9 * outside);
      // Least squares do not know the constraints, and would leave them again.
      const bool leaves_constraints = is_least_squares(last_) && !study_.constraints.empty();
      const bool begins_anew = trials_.have_best() && !leaves_constraints && (k == 0 || has_gained);
      if (!begins_anew && ++algorithm == algorithms_.size()) break;
      attempt.relative_tolerance =
          begins_anew ? std::max(kLeastTolerance, kTighten * attempt.relative_tolerance)
                      : options_.relative_tolerance;
    }
    trials_.conclude(failure_);
    return std::move(result_);
  }

 private:
  void try_from(const Eigen::VectorXd& rho, const std::string& algorithm,
                OptimizerOptions* attempt) {
    attempt->algorithm = algorithm;
    if (last_ != algorithm)
      result_.algorithm += (result_.algorithm.empty() ? "" : ", ") + algorithm;
    last_ = algorithm;
    failure_.clear();
    const Scaling scaling = trials_.have_best() ? trials_.judged_scaling() : scaling_;
    if (is_least_squares(algorithm))
      search_squares(*attempt, rho, scaling, &trials_);
    else
      failure_ = minimize(study_, *attempt, scaling, rho, &program_, &trials_);
  }

  /// Whether the search may not end at the stop of the attempt, and has evaluations left.
  bool goes_on() {
    if (trials_.interrupted() || result_.cost.evaluations >= options_.max_evaluations) return false;
    if (result_.termination == "max_evaluations_reached" || !uses_gradients(last_)) return false;
    // A weight of this start is negative, so that the objective is no sum of squares.
    if (!trials_.have_best()) return trials_.first_failure().code == StatusCode::kInvalidDesign;
    if (!trials_.best_keeps_bounds()) return algorithms_.size() > 1;
    return !trials_.is_stationary() || trials_.finds_lower_point();
  }

  const Study& study_;
  const OptimizerOptions& options_;
  const Scaling scaling_;
  SmoothProgram program_;
  SearchTrials trials_;
  OptimizationResult& result_ = trials_.result();
  const std::vector<std::string> algorithms_;
  std::string last_, failure_;
};

}  // namespace

void check_search(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble) {
  const RobustMeasure measure = measure_of(ensemble);
  check_algorithm(study, options, has_slack(measure));
  if (is_least_squares(options.algorithm)) check_squares(study, options, measure);
}

OptimizationResult search_locally(const Study& study, const OptimizerOptions& options,
                                  const Eigen::VectorXd& start, const Ensemble& ensemble,
                                  const TrialObserver& observer, const std::atomic<bool>* cancel) {
  check_search(study, options, ensemble);
  return Search(study, options, ensemble, observer, cancel).run(start);
}

}  // namespace codesign
