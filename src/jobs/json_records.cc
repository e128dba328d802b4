// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/json_records.h"

#include <algorithm>
#include <cmath>

#include "assembly/count_equations.h"
#include "description/study.h"
#include "elements/design.h"
#include "ensemble/ensemble.h"
#include "equations/compiled_system.h"
#include "jobs/json.h"
#include "jobs/optimization_records.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "optimization/result_report.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// The check belongs to writing files, so it must not make a job noticeably longer: this share of
/// the search's processor time, or these seconds.
constexpr double kShare = 0.1, kUnnoticed = 0.5;

Json bound_json(double bound) { return std::isfinite(bound) ? Json(bound) : Json(nullptr); }

/// The bound on which a tuned value lies, within rounding.
const char* bound_of(const Parameter& parameter, double value) {
  const auto is_on = [value](double bound) {
    return std::isfinite(bound) && std::abs(value - bound) <= 1e-9 * std::max(1.0, std::abs(bound));
  };
  return is_on(parameter.lower) ? "lower" : is_on(parameter.upper) ? "upper" : "";
}

/// The time that the check takes [s]: two gradients, and along each direction a complex run, which
/// is not compiled and takes about as long as forty gradients, or Ridders' extrapolation, about as
/// long as twenty.
double expected_seconds(const Problem& problem, const OptimizationResult& result) {
  const double evaluations = std::max(1, result.cost.evaluations);
  const double runs = study_of(problem).solver.integrator == IntegratorKind::kIdas ? 20.0 : 40.0;
  const auto directions =
      static_cast<double>(std::min<Eigen::Index>(result.best.rho.size(), kCheckedDirections));
  return (2.0 + runs * directions) * result.cost.statistics.cpu_seconds / evaluations;
}

Json skipped(const std::string& why) { return {{"skipped", why}}; }

}  // namespace

Json to_json(const InputError& error) {
  const InputFault& fault = error.fault();
  return {{"code", "bad_input"},      {"message", error.what()},  {"file", fault.where.file},
          {"line", fault.where.line}, {"element", fault.element}, {"value", fault.value},
          {"allowed", fault.allowed}};
}

Json to_json(const std::vector<LimitCrossing>& crossings) { return records_json(crossings); }

std::vector<MachineNumber> machine_numbers_of(const Problem& problem,
                                              const std::vector<double>& parameters) {
  const CompiledSystem& system = *system_of(problem);
  Design<double> design;
  design.set(system, parameters);
  return machine_numbers(system.robot(), system.topology(), system.study(), design.constants);
}

Json to_json(const std::vector<MachineNumber>& numbers) { return records_json(numbers); }

void add_events(const Events& events, Json* object) {
  (*object)["events"] = records_json(events.list);
  (*object)["event_count"] = events.count;
}

Json to_json(const Status& status) { return record_json(status); }

Json to_json(const Warnings& warnings) { return records_json(warnings); }

void add_statistics(const Statistics& statistics, Json* object) { add_fields(statistics, object); }

void add_outcome(const Problem& problem, const Warnings& of_run, const Status& status,
                 Json* object) {
  Warnings warnings = problem.warnings();
  append(of_run, &warnings);
  (*object)["setup_seconds"] = problem.setup_seconds();
  (*object)["warnings"] = to_json(warnings);
  if (!status.ok()) (*object)["error"] = to_json(status);
}

void add_counts(const Problem& problem, const std::vector<double>& parameters, Json* object) {
  Status status;
  const Counts counts = count_equations(*system_of(problem), parameters, &status);
  if (status.ok()) (*object)["counts"] = record_json(counts);
}

Json parameter_table(const Problem& problem, const OptimizationResult& result) {
  const Study& study = study_of(problem);
  const std::vector<double> initial = problem.parameters(result.initial.rho),
                            tuned = problem.parameters(result.best.rho);
  Json table = Json::array();
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const Parameter& parameter = study.parameters[i];
    const bool is_tuned =
        std::count(study.tuned.begin(), study.tuned.end(), static_cast<int>(i)) > 0;
    table.push_back({{"name", parameter.name},
                     {"unit", parameter.unit},
                     {"tuned", is_tuned},
                     {"lower", bound_json(parameter.lower)},
                     {"upper", bound_json(parameter.upper)},
                     {"initial", initial[i]},
                     {"value", tuned[i]},
                     {"bound", is_tuned ? bound_of(parameter, tuned[i]) : ""}});
  }
  return table;
}

Json differences_json(const IndependentCheck& check) { return record_json(check); }

namespace {

Json exact_check_json(const Problem& problem, const OptimizationResult& result,
                      const std::atomic<bool>* cancel) {
  if (!is_evaluated(problem, result) || result.status.is_interrupted())
    return skipped("the search was interrupted");
  if (const double seconds = expected_seconds(problem, result);
      seconds > std::max(kUnnoticed, kShare * result.cost.statistics.cpu_seconds))
    return skipped("it would take about " + readable(std::ceil(seconds)) +
                   " s, more than a tenth of the search; codesign gradient --verify does it");
  const CheckMethod method = study_of(problem).solver.integrator == IntegratorKind::kIdas
                                 ? CheckMethod::kRidders
                                 : CheckMethod::kComplexStep;
  GradientCheck check;
  try {
    check = check_along(Ensemble(problem), result.best.rho, method, cancel);
  } catch (const InputError& error) {
    // The gradient cannot be checked, for example because the processes of the engine are missing.
    return skipped(error.what());
  }
  if (!check.status.ok()) return skipped(describe(check.status));
  const std::vector<std::string> names = problem.tuned_names();
  Json object = {{"method", name_of(method)},
                 {"gradient", by_name(names, check.evaluation.gradient)},
                 {"largest_relative_difference", check.largest_relative_difference}};
  if (check.directions.size() > 0)
    object["directions"] = check.directions.cols();
  else
    object["reference"] = by_name(names, check.reference);
  return object;
}

}  // namespace

Json gradient_check_json(const Problem& problem, const OptimizationResult& result,
                         const std::atomic<bool>* cancel) {
  Json object = exact_check_json(problem, result, cancel);
  const IndependentCheck& independent = result.optimality.independent;
  if (independent.evaluations > 0) object["differences"] = differences_json(independent);
  return object;
}

}  // namespace codesign
