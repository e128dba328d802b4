// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/confirmation.h"

#include <algorithm>
#include <cmath>

#include "description/study.h"
#include "ensemble/other_steps.h"
#include "math/arrays.h"
#include "optimization/algorithm.h"
#include "optimization/search_trials.h"
#include "sampling/measure.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// As SearchTrials::scale().
constexpr double kOfStart = 1e-3;

bool has_claim(const Study& study, const Ensemble& ensemble, const OptimizationResult& result) {
  const bool has_ended = result.status.ok() &&
                         (is_success(result.termination) || result.termination == "stopped_early");
  return has_ended && study.postures == 0 &&
         result.best.gradient.size() == to_signed(study.tuned.size()) &&
         result.best.values.size() == to_signed(ensemble.scenarios().size());
}

ClaimedGradient claim_of(const OptimizerOptions& options, const Ensemble& ensemble,
                         const OptimizationResult& result) {
  const DesignPoint& best = result.best;
  ClaimedGradient claim;
  claim.gradient = best.gradient;
  claim.by_value = best.values.size() == 1
                       ? Eigen::VectorXd::Ones(1)
                       : measure(ensemble.options(), best.values, ensemble.weights()).by_value;
  count_worst_for_failed(best.failed, best.values, &claim.by_value);
  claim.objective = claim.by_value.dot(best.values);
  claim.statistics = result.cost.statistics;
  claim.runs = static_cast<double>(result.cost.evaluations) *
               static_cast<double>(ensemble.scenarios().size());
  const double start = std::isfinite(result.initial.slope) ? result.initial.slope : 0.0;
  claim.allowed_per_range =
      most_stationarity(options) * std::max(std::abs(best.objective), kOfStart * start);
  return claim;
}

}  // namespace

void confirm_stop(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble,
                  const std::atomic<bool>* cancel, OptimizationResult* result) {
  if (!has_claim(study, ensemble, *result)) return;
  const ClaimedGradient claim = claim_of(options, ensemble, *result);
  IndependentCheck& check = result->optimality.independent;
  check = check_other_steps(ensemble, result->best.rho, claim, false, cancel);
  result->cost.statistics += check.statistics;
  if (check.status.is_interrupted()) {
    result->status = with_best_kept(check.status);
    result->termination = name_of(check.status.code);
    return;
  }
  if (!check.disagrees()) return;
  result->termination = "stopped_early";
  append({disagreement(ensemble, check, claim.objective)}, &result->warnings);
}

std::string describe_confirmation(const OptimizationResult& result) {
  const IndependentCheck& check = result.optimality.independent;
  if (!check.status.ok())
    return ", by the gradient alone: differences of the objective are not known (" +
           reason(check.status) + ")";
  if (check.is_known() && check.error > check.allowed)
    return ", by the gradient alone: differences of the objective have an error of " +
           readable(check.error / check.size, 2) + " of it";
  return "";
}

}  // namespace codesign
