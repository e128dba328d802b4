// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_results.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "math/dense.h"
#include "optimization/algorithm.h"
#include "optimization/confirmation.h"
#include "optimization/local_search.h"
#include "optimization/scaling.h"
#include "optimization/search_trials.h"
#include "problem/load_problem.h"
#include "sampling/measure.h"
#include "text/cancel.h"
#include "text/number_text.h"

namespace codesign {
namespace {

ScenarioResult describe(const Study& study, const Scenario& scenario, double initial,
                        double final) {
  ScenarioResult result{scenario.run, scenario.sample, scenario.weight,      {},
                        initial,      final,           scenario.friction_law};
  for (const auto& [index, value] : scenario.values)
    result.values.emplace_back(study.parameters[to_index(index)].name, value);
  return result;
}

/// The weight of the values up to `bound`; failed scenarios are not among the values and count as
/// larger than `bound`.
double share_within(double bound, const std::vector<double>& values,
                    const std::vector<double>& weights) {
  double share = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] <= bound) share += weights[k];
  return share;
}

/// Evaluates the design on fresh samples. Unlike in the search, a failed sample does not make the
/// design fail; it is only counted.
/// @returns std::nullopt if the validation was interrupted, or if its measure overflows. @param
/// failure receives the status of that.
std::optional<Validation> validate(const Problem& problem, const Ensemble& ensemble,
                                   const OptimizationResult& design,
                                   const std::atomic<bool>* cancel, ProgressMeter* meter,
                                   Status* failure) {
  const RobustOptions& options = ensemble.options();
  const std::vector<Scenario> scenarios = make_validation_scenarios(problem, options.validate);
  meter->begin(SearchStage::kValidating, 1, scenarios.size());
  const std::vector<Evaluation> members =
      ensemble.engine().evaluate(tasks_at(scenarios, design.best.rho, Derivatives::kNone), cancel);
  Validation validation;
  validation.samples = options.validate;
  validation.promised = design.best.objective;
  std::vector<double> values, weights;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].status.is_interrupted()) {
      *failure = members[k].status;
      return std::nullopt;
    }
    if (!members[k].status.ok()) {
      ++validation.failed;
      continue;
    }
    values.push_back(members[k].objective);
    weights.push_back(scenarios[k].weight);
  }
  if (values.empty()) return validation;
  const Eigen::VectorXd psi = Eigen::Map<Eigen::VectorXd>(values.data(), to_signed(values.size()));
  Eigen::VectorXd w = Eigen::Map<Eigen::VectorXd>(weights.data(), psi.size());
  w /= w.sum();
  const Measured measured = measure(options, psi, w);
  if (!std::isfinite(measured.value)) {
    *failure = {StatusCode::kNonFinite, study_of(problem).duration,
                "the measure over the fresh samples of robust.validate is not finite"};
    return std::nullopt;
  }
  validation.objective = measured.value;
  if (design.ensemble.value_at_risk) {
    validation.value_at_risk = measured.threshold;
    validation.within = share_within(*design.ensemble.value_at_risk, values, weights);
  }
  validation.mean = w.dot(psi);
  validation.worst = psi.maxCoeff();
  return validation;
}

/// A parameter counts as on its bound within this fraction of its range.
constexpr double kOnBound = 1e-6;
constexpr double kWidening = 0.01;  // of the range, for the worth of a bound
constexpr Eigen::Index kMostListed = 5;
constexpr double kEndless = 1e6;  // extents beyond which an objective counts as falling without end

void add_evaluations_warning(const Study& study, const OptimizerOptions& options,
                             const OptimizationResult& result, Warnings* warnings) {
  if (result.termination != "max_evaluations_reached") return;
  warnings->push_back(
      warn("max_evaluations_reached", {where_of(options, study), "optimizer.max_evaluations",
                                       "the search stopped at the limit of evaluations before it "
                                       "converged; the best point so far is returned; allow more "
                                       "evaluations or a larger optimizer.relative_tolerance",
                                       std::to_string(options.max_evaluations), ""}));
}

bool is_on(double value, double bound, const Parameter& parameter) {
  if (!std::isfinite(bound)) return false;
  const double range = parameter.upper - parameter.lower,
               scale = std::isfinite(range) ? range : std::max(std::abs(bound), 1.0);
  return std::abs(value - bound) <= kOnBound * scale;
}

// Warns only if the objective falls beyond the bound while all constraints are kept, so that the
// bound determines the value. A parameter that a search has fixed lies on both of its bounds, which
// tells nothing.
void add_bound_warning(const Parameter& parameter, double value, double multiplier,
                       double objective, Warnings* warnings) {
  if (parameter.lower == parameter.upper) return;
  const bool at_lower = is_on(value, parameter.lower, parameter) && multiplier > 0.0;
  const bool at_upper = is_on(value, parameter.upper, parameter) && multiplier < 0.0;
  const double worth = kWidening * std::abs(multiplier),
               share = objective != 0.0 ? worth / std::abs(objective) : 1.0;
  if (!at_lower && !at_upper) return;
  warnings->push_back(
      warn("parameter_on_bound",
           {parameter.where, parameter.name,
            std::string("the best value lies on its ") + (at_lower ? "lower" : "upper") +
                " bound; to widen the bound by " +
                (has_range(parameter) ? "1 % of the range"
                                      : readable(kWidening * extent(parameter, value), 2)) +
                " would lower the objective by about " + readable(worth, 2) + " (" +
                readable(100.0 * share, 2) + " %); widen it if it was a guess",
            to_decimal(value),
            "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]"}));
}

/// The parameters without a bound along which a negative objective fell until they were large.
std::string endless(const Study& study, const OptimizationResult& result) {
  std::string names;
  for (std::size_t k = 0; k < study.tuned.size() && result.best.objective < 0.0; ++k) {
    const Parameter& parameter = study.parameters[to_index(study.tuned[k])];
    if (std::abs(result.best.rho[to_signed(k)]) > kEndless * extent(parameter, 0.0))
      names += (names.empty() ? "" : ", ") + parameter.name;
  }
  return names.empty()
             ? ""
             : ", and the objective falls without end along " + names + ": give it bounds";
}

void add_stop_warning(const Study& study, const OptimizerOptions& options,
                      const OptimizationResult& result, Warnings* warnings) {
  if (!result.optimality.unjudged.empty())
    warnings->push_back(warn(
        "objective_jumps",
        {where_of(options, study), "optimizer",
         "no slope tells whether the best point is an optimum: " + result.optimality.unjudged +
             "; compare values of these parameters one by one, each fixed by tune: false, or write "
             "what they do without jumps",
         "", ""}));
  if (result.termination != "stopped_early" || !result.optimality.unjudged.empty()) return;
  warnings->push_back(warn(
      "not_stationary",
      {where_of(options, study), "optimizer",
       (std::isfinite(result.optimality.stationarity)
            ? stop_sentence(result)
            : "stopped early, where the slope is not finite") +
           endless(study, result) +
           "; no algorithm gains from there, so that it may not be an optimum; try another start "
           "or another algorithm, a smaller "
           "solver.relative_tolerance if the objective is rough, or narrower bounds",
       "", "a stationarity of at most " + readable(std::sqrt(options.relative_tolerance), 2)}));
}

void add_flat_warning(const Study& study, const OptimizerOptions& options,
                      const OptimizationResult& result, Warnings* warnings) {
  const Eigen::MatrixXd& points = result.optimality.flat_points;
  const Eigen::Index count = points.cols();
  if (count == 0) return;
  std::string list;
  for (Eigen::Index d = 0; d < std::min<Eigen::Index>(count, kMostListed); ++d) {
    std::string point;
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      if (points(k, d) == result.best.rho[k]) continue;
      const Parameter& parameter = tuned_parameter(study, k);
      point += (point.empty() ? "" : ", ") + parameter.name + " " + readable(points(k, d));
    }
    list += (d == 0 ? "" : "; or ") + point;
  }
  if (count > kMostListed) list += "; or ...";
  warnings->push_back(
      warn("flat_direction",
           {where_of(options, study), "parameters",
            "the optimum is not one point: the objective does not change along " +
                (count == 1 ? std::string("a direction") : std::to_string(count) + " directions") +
                " of the parameters, so that other values are as good, such as " + list +
                "; fix one parameter of each direction, or add a term to the objective that "
                "prefers a value",
            "", ""}));
}

using Eigen::Index;

constexpr double kBalances = 1e-6;  // smaller entries of a direction are rounding

/// The rows of a basis reduced so that each has one parameter of its own, the one that moves most.
void reduce(Eigen::MatrixXd* rows) {
  for (Index k = 0; k < rows->rows(); ++k) {
    Index row = 0, column = 0;
    rows->bottomRows(rows->rows() - k).cwiseAbs().maxCoeff(&row, &column);
    rows->row(k).swap(rows->row(k + row));
    rows->row(k) /= (*rows)(k, column);
    for (Index other = 0; other < rows->rows(); ++other)
      if (other != k) rows->row(other) -= ((*rows)(other, column) * rows->row(k)).eval();
  }
}

/// The parameters that move, and the singular values and vectors of R and the active rows by them.
struct Stacked {
  std::vector<Index> moving;
  SingularValues svd;
  Index flat = 0;  ///< number of the last vectors whose values count as zero
};

Stacked decompose(const Eigen::MatrixXd& root, const Eigen::MatrixXd& active,
                  const std::vector<bool>& held) {
  Stacked result;
  for (Index k = 0; k < root.cols(); ++k)
    if (!held[to_index(k)]) result.moving.push_back(k);
  const auto count = static_cast<Index>(result.moving.size());
  Eigen::MatrixXd stacked(root.rows() + active.cols(), count);
  for (Index k = 0; k < count; ++k) {
    stacked.col(k).head(root.rows()) = root.col(result.moving[to_index(k)]);
    stacked.col(k).tail(active.cols()) = active.row(result.moving[to_index(k)]).transpose();
  }
  // A constraint holds its direction whatever its unit.
  const double size = stacked.topRows(root.rows()).norm();
  for (Index k = root.rows(); k < stacked.rows(); ++k)
    if (const double norm = stacked.row(k).norm(); norm > 0.0) stacked.row(k) *= size / norm;
  if (count == 0 || !(size > 0.0)) return {};
  result.svd = singular_values(stacked, SingularVectors::kRight);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count);
  values.head(result.svd.values.size()) = result.svd.values;
  result.flat = (values.array().square() < kFlatShare * values[0] * values[0]).count();
  return result;
}

}  // namespace

void describe_scenarios(const Problem& problem, const Ensemble& ensemble,
                        const std::atomic<bool>* cancel, ProgressMeter* meter,
                        OptimizationResult* result) {
  const std::vector<Scenario>& scenarios = ensemble.scenarios();
  const bool known = result->best.values.size() == to_signed(scenarios.size()) &&
                     result->initial.values.size() == result->best.values.size();
  if (!study_of(problem).ensemble.is_ensemble() || !known) return;
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    const auto i = to_signed(k);
    result->ensemble.scenarios.push_back(describe(
        study_of(problem), scenarios[k], result->initial.values[i], result->best.values[i]));
  }
  for (int k : result->initial.failed)
    result->ensemble.scenarios[to_index(k)].initial_failed = true;
  for (int k : result->best.failed) result->ensemble.scenarios[to_index(k)].failed = true;
  if (ensemble.options().measure == RobustMeasure::kCvar)
    result->ensemble.value_at_risk =
        measure(ensemble.options(), result->best.values, ensemble.weights()).threshold;
  if (ensemble.options().validate == 0 || is_set(cancel)) return;
  Status failure;
  result->ensemble.validation = validate(problem, ensemble, *result, cancel, meter, &failure);
  if (failure.ok()) return;
  result->status = with_best_kept(failure);
  result->termination = name_of(failure.code);
}

Scenario scenario_of(const Problem& problem, const ScenarioResult& result) {
  const std::vector<Parameter>& parameters = study_of(problem).parameters;
  std::vector<Scenario> known = make_scenarios(problem);
  Scenario scenario = *std::find_if(known.begin(), known.end(), [&](const Scenario& one) {
    return one.run == result.run && one.friction_law == result.friction_law;
  });
  scenario.sample = result.sample;
  scenario.weight = result.weight;
  scenario.values.clear();
  for (const auto& [name, value] : result.values) {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&name = name](const Parameter& p) { return p.name == name; });
    scenario.values.emplace_back(static_cast<int>(found - parameters.begin()), value);
  }
  return scenario;
}

namespace {

std::string count_of(int number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

/// What is claimed of a design that was chosen from lists.
std::string choice_sentence(const OptimizationResult& result) {
  const ChoiceResult& choice = result.choice;
  const std::string all = readable(choice.combinations, 10);
  std::string text =
      "best of the " + count_of(choice.searched, "combination") + " searched, of " + all;
  if (choice.is_complete && choice.relaxations == 0)
    text = "best of " + all + " combinations, each searched";
  else if (choice.is_complete)
    text = "best of " + all + " combinations: " + std::to_string(choice.searched) +
           " searched, the others left out by the bounds of " +
           count_of(choice.relaxations, "relaxation") +
           ", which hold where the search of a relaxation has found its least value";
  if (choice.unfinished > 0)
    text += "; the search of " + count_of(choice.unfinished, "combination") +
            " ended before an optimum, which may be better";
  if (!std::isfinite(result.optimality.stationarity)) return text;
  return text + "; the parameters that are not chosen are stationary to " +
         readable(result.optimality.stationarity, 2) +
         (result.termination == "stopped_early" ? " only" : "") + describe_confirmation(result);
}

}  // namespace

std::string stop_sentence(const OptimizationResult& result) {
  if (result.choice.combinations > 0.0) return choice_sentence(result);
  if (!result.optimality.unjudged.empty())
    return std::string(result.termination == "stopped_early" ? "stopped early: " : "") +
           "no slope tells whether this is an optimum: " + result.optimality.unjudged;
  if (!std::isfinite(result.optimality.stationarity)) return "";
  const std::string to = readable(result.optimality.stationarity, 2);
  if (is_success(result.termination)) return "stationary to " + to + describe_confirmation(result);
  if (result.optimality.independent.disagrees())
    return "stopped early: stationary to " + to +
           " by the gradient, which differences of the objective refute";
  // A start at which nothing has an effect on the objective has no slope.
  const std::string slope = result.initial.slope > 0.0
                                ? "the slope is " +
                                      readable(result.best.slope / result.initial.slope, 2) +
                                      " of the start's, "
                                : "";
  return "stopped early: " + slope + "stationary to " + to + " only";
}

Warnings search_warnings(const Study& study, const OptimizerOptions& options,
                         const OptimizationResult& result) {
  Warnings warnings;
  add_evaluations_warning(study, options, result, &warnings);
  add_stop_warning(study, options, result, &warnings);
  for (std::size_t k = 0; k < study.tuned.size(); ++k) {
    const Parameter& parameter = study.parameters[to_index(study.tuned[k])];
    const auto i = to_signed(k);
    add_bound_warning(parameter, result.best.rho[i], result.optimality.bound_multipliers[i],
                      result.best.objective, &warnings);
    if (!result.optimality.influences[k])
      warnings.push_back(
          warn("parameter_without_influence",
               {parameter.where, parameter.name,
                "the derivative of the objective by it was zero at every trial point, "
                "so its value is not tuned; remove it from the study's parameters, "
                "give {tune: false}, or another start",
                to_decimal(result.best.rho[i]), ""}));
  }
  add_flat_warning(study, options, result, &warnings);
  return warnings;
}

Eigen::MatrixXd flat_directions(const Eigen::MatrixXd& root, const Eigen::MatrixXd& active,
                                const std::vector<bool>& held) {
  const auto [moving, svd, flat] = decompose(root, active, held);
  if (moving.empty()) return Eigen::MatrixXd(root.cols(), 0);
  Eigen::MatrixXd rows = svd.V.rightCols(flat).transpose();
  reduce(&rows);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(root.cols(), flat);
  for (Index k = 0; k < rows.cols(); ++k)
    for (Index d = 0; d < flat; ++d)
      if (std::abs(rows(d, k)) > kBalances) directions(moving[to_index(k)], d) = rows(d, k);
  return directions;
}

ValleyFloor valley_floor(double value, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root,
                         const Eigen::MatrixXd& active, const std::vector<bool>& held) {
  const auto [moving, svd, flat] = decompose(root, active, held);
  ValleyFloor floor{value, Eigen::VectorXd::Zero(root.cols())};
  for (Index i = 0; i + flat < to_signed(moving.size()); ++i) {
    double slope = 0.0;
    for (std::size_t k = 0; k < moving.size(); ++k)
      slope += svd.V(to_signed(k), i) * gradient[moving[k]];
    floor.value -= std::pow(0.5 * slope / svd.values[i], 2);
    for (std::size_t k = 0; k < moving.size(); ++k)
      floor.step[moving[k]] -=
          0.5 * slope / (svd.values[i] * svd.values[i]) * svd.V(to_signed(k), i);
  }
  return floor;
}

}  // namespace codesign
