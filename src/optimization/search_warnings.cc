// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_warnings.h"

#include <cmath>

#include "description/study.h"
#include "optimization/algorithm.h"
#include "text/decimal.h"

namespace codesign {
namespace {

/// A parameter counts as on its bound within this fraction of its range.
constexpr double kOnBound = 1e-6;

void add_evaluations_warning(const Study& study, const OptimizerOptions& options, const OptimizationResult& result, Warnings* warnings) {
  if (result.termination != "max_evaluations_reached") return;
  warnings->push_back(
      warn("max_evaluations_reached",
           {where_of(options, study), "optimizer.max_evaluations",
            "the search stopped at the limit of evaluations before it converged; the best point so far is returned; allow more "
            "evaluations or a larger optimizer.relative_tolerance",
            std::to_string(options.max_evaluations), ""}));
}

bool is_on(double value, double bound, const Parameter& parameter) {
  if (!std::isfinite(bound)) return false;
  const double range = parameter.upper - parameter.lower, scale = std::isfinite(range) ? range : std::max(std::abs(bound), 1.0);
  return std::abs(value - bound) <= kOnBound * scale;
}

// Warns only if the objective falls beyond the bound, so that the bound and not the objective determines the value.
void add_bound_warning(const Parameter& parameter, double value, double slope, Warnings* warnings) {
  const bool at_lower = is_on(value, parameter.lower, parameter) && slope > 0.0;
  const bool at_upper = is_on(value, parameter.upper, parameter) && slope < 0.0;
  if (!at_lower && !at_upper) return;
  warnings->push_back(
      warn("parameter_on_bound", {parameter.where, parameter.name,
                                  std::string("the best value lies on its ") + (at_lower ? "lower" : "upper") +
                                      " bound, and the objective falls further beyond it; widen the bound if it was a guess",
                                  to_decimal(value), "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]"}));
}

}  // namespace

Warnings search_warnings(const Study& study, const OptimizerOptions& options, const OptimizationResult& result) {
  Warnings warnings;
  add_evaluations_warning(study, options, result, &warnings);
  for (std::size_t k = 0; k < study.tuned.size(); ++k) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(study.tuned[k])];
    const auto i = static_cast<Eigen::Index>(k);
    add_bound_warning(parameter, result.rho[i], result.gradient[i], &warnings);
    if (!result.influences[k])
      warnings.push_back(
          warn("parameter_without_influence",
               {parameter.where, parameter.name,
                "the objective did not change with this parameter at any trial point, so its value is not tuned; remove it from the "
                "study's parameters, or give {tune: false}",
                to_decimal(result.rho[i]), ""}));
  }
  return warnings;
}

}  // namespace codesign
