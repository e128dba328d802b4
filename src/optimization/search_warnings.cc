// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_warnings.h"

#include <algorithm>
#include <cmath>

#include "description/study.h"
#include "optimization/algorithm.h"
#include "text/decimal.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A parameter counts as on its bound within this fraction of its range.
constexpr double kOnBound = 1e-6;
constexpr double kWidening = 0.01;  // of the range, for the worth of a bound
constexpr Eigen::Index kMostListed = 5;

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

// Warns only if the objective falls beyond the bound while all constraints are kept, so that the bound determines the value.
void add_bound_warning(const Parameter& parameter, double value, double multiplier, double objective, Warnings* warnings) {
  const bool at_lower = is_on(value, parameter.lower, parameter) && multiplier > 0.0;
  const bool at_upper = is_on(value, parameter.upper, parameter) && multiplier < 0.0;
  const double worth = kWidening * std::abs(multiplier), share = objective != 0.0 ? worth / std::abs(objective) : 1.0;
  if (!at_lower && !at_upper) return;
  warnings->push_back(
      warn("parameter_on_bound", {parameter.where, parameter.name,
                                  std::string("the best value lies on its ") + (at_lower ? "lower" : "upper") +
                                      " bound; to widen the bound by 1 % of the range would lower the objective by about " +
                                      readable(worth, 2) + " (" + readable(100.0 * share, 2) + " %); widen it if it was a guess",
                                  to_decimal(value), "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]"}));
}

void add_stop_warning(const Study& study, const OptimizerOptions& options, const OptimizationResult& result, Warnings* warnings) {
  if (result.termination != "stopped_early") return;
  warnings->push_back(
      warn("not_stationary",
           {where_of(options, study), "optimizer",
            stop_sentence(result) +
                "; no algorithm gains from there, so that it may not be an optimum; try another start or another algorithm, a smaller "
                "solver.relative_tolerance if the objective is rough, or narrower bounds",
            "", "a stationarity of at most " + readable(std::sqrt(options.relative_tolerance), 2)}));
}

void add_flat_warning(const Study& study, const OptimizerOptions& options, const OptimizationResult& result, Warnings* warnings) {
  const Eigen::Index count = result.flat_directions.cols();
  if (count == 0) return;
  std::string list;
  for (Eigen::Index d = 0; d < std::min<Eigen::Index>(count, kMostListed); ++d) {
    std::string direction;
    for (Eigen::Index k = 0; k < result.flat_directions.rows(); ++k) {
      const double by = result.flat_directions(k, d);
      if (by == 0.0) continue;
      const Parameter& parameter = study.parameters[static_cast<std::size_t>(study.tuned[static_cast<std::size_t>(k)])];
      direction += (direction.empty() ? "" : ", ") + parameter.name + (by > 0.0 ? " +" : " ") + readable(by, 3);
    }
    list += (d == 0 ? "" : "; ") + direction;
  }
  if (count > kMostListed) list += "; ...";
  warnings->push_back(
      warn("flat_direction", {where_of(options, study), "parameters",
                              "the optimum is not one point: the objective does not change along " +
                                  (count == 1 ? std::string("a direction") : std::to_string(count) + " directions") +
                                  " of the parameters, so that other values are as good (" + list +
                                  "); fix one parameter of each direction, or add a term to the objective that prefers a value",
                              "", ""}));
}

}  // namespace

std::string stop_sentence(const OptimizationResult& result) {
  if (!std::isfinite(result.stationarity)) return "";
  if (is_success(result.termination)) return "stationary to " + readable(result.stationarity, 2);
  // A start at which nothing has an effect on the objective has no slope.
  const std::string slope =
      result.initial_slope > 0.0 ? "the slope is " + readable(result.slope / result.initial_slope, 2) + " of the start's, " : "";
  return "stopped early: " + slope + "stationary to " + readable(result.stationarity, 2) + " only";
}

Warnings search_warnings(const Study& study, const OptimizerOptions& options, const OptimizationResult& result) {
  Warnings warnings;
  add_evaluations_warning(study, options, result, &warnings);
  add_stop_warning(study, options, result, &warnings);
  for (std::size_t k = 0; k < study.tuned.size(); ++k) {
    const Parameter& parameter = study.parameters[static_cast<std::size_t>(study.tuned[k])];
    const auto i = static_cast<Eigen::Index>(k);
    add_bound_warning(parameter, result.rho[i], result.bound_multipliers[i], result.objective, &warnings);
    if (!result.influences[k])
      warnings.push_back(
          warn("parameter_without_influence",
               {parameter.where, parameter.name,
                "the objective did not change with this parameter at any trial point, so its value is not tuned; remove it from the "
                "study's parameters, or give {tune: false}",
                to_decimal(result.rho[i]), ""}));
  }
  add_flat_warning(study, options, result, &warnings);
  return warnings;
}

}  // namespace codesign
