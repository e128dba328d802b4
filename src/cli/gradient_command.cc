// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "ensemble/ensemble.h"
#include "ensemble/other_steps.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

GradientCheck compute(const Arguments& arguments, const Problem& problem, const Console& console) {
  const Ensemble ensemble(problem, 1, {nullptr, nullptr, console.ranks});
  if (arguments.verify) {
    GradientCheck check;
    if (!arguments.each_parameter)
      check = check_along(ensemble, problem.start(), arguments.method, &console.cancel);
    // A disagreement is shown parameter by parameter.
    if (arguments.each_parameter ||
        (check.status.ok() && check.directions.size() > 0 && disagrees(check)))
      check = check_gradient(ensemble, problem.start(), arguments.method, &console.cancel);
    check_other_steps(ensemble, problem.start(), &console.cancel, &check);
    check_steps(ensemble, problem.start(), &console.cancel, &check);
    return check;
  }
  GradientCheck result;
  result.evaluation = ensemble.evaluate(problem.start(), true, &console.cancel).total;
  result.status = result.evaluation.status;
  return result;
}

/// What differences through other steps say, with their own error.
void print_differences(const IndependentCheck& check, std::ostream& out) {
  if (check.evaluations == 0) return;
  if (!check.is_known()) {
    out << "differences of the objective through other steps: not known, " << describe(check.status)
        << '\n';
    return;
  }
  out << "differences of the objective (" << describe_steps(check)
      << "): " << readable(check.derivative) << " with an error of " << readable(check.error, 2)
      << "; by the gradient " << readable(check.along) << '\n';
}

void print_table(const Problem& problem, const GradientCheck& result, std::ostream& out) {
  const std::vector<std::string> names = problem.tuned_names();
  const Eigen::VectorXd rho = problem.start();
  const bool along = result.directions.size() > 0,
             verified = !along && result.reference.size() == rho.size();
  Table table;
  std::vector<std::string> header = {"parameter", "value", "gradient"};
  const bool has_error = verified && result.method == CheckMethod::kRidders;
  if (verified) header.insert(header.end(), {name_of(result.method), "difference"});
  if (has_error) header.push_back("error");
  table.add(std::move(header));
  for (Eigen::Index k = 0; k < rho.size(); ++k) {
    const double gradient = result.evaluation.gradient[k];
    std::vector<std::string> row = {names[to_index(k)], readable(rho[k]), readable(gradient)};
    if (verified)
      row.insert(row.end(),
                 {readable(result.reference[k]), readable(gradient - result.reference[k])});
    if (has_error) row.push_back(readable(result.reference_error[k], 2));
    table.add(std::move(row));
  }
  out << "objective " << readable(result.evaluation.objective) << '\n';
  table.print(out);
  if (along)
    out << "verified with " << name_of(result.method)
        << " along a direction in which every parameter has its part; --verify="
        << name_of(result.method) << " verifies each parameter\n";
  if (verified || along)
    out << "largest relative difference " << readable(result.largest_relative_difference) << '\n';
  if (result.finer.size() > 0)
    out << "largest change with a hundredth of the tolerances " << readable(result.largest_change)
        << '\n';
  print_differences(result.independent, out);
}

Json result_json(const Arguments& arguments, const Problem& problem, const GradientCheck& result,
                 const Json& counts) {
  const std::vector<std::string> names = problem.tuned_names();
  Json object;
  if (result.evaluation.status.ok()) object["objective"] = result.evaluation.objective;
  object["parameters"] = parameters_json(problem, problem.parameters());
  if (result.evaluation.gradient.size() > 0)
    object["gradient"] = by_name(names, result.evaluation.gradient);
  add_statistics(result.evaluation.statistics, &object);
  add_events(result.evaluation.events, &object);
  object.update(counts);
  if (!arguments.verify || !result.status.ok()) return object;
  Json& verification = object["verification"] = record_json(result);
  if (result.directions.size() > 0) return object;
  verification["reference"] = by_name(names, result.reference);
  verification["reference_error"] = by_name(names, result.reference_error);
  return object;
}

}  // namespace

int gradient(const Arguments& arguments, const Console& console) {
  const Problem problem = load_tunable(arguments, &console);
  // Counted before the computation, so that a cancelled command ends without further work.
  Json counts = Json::object();
  if (arguments.json) add_counts(problem, problem.parameters(), &counts);
  const GradientCheck result = compute(arguments, problem, console);
  const bool known = result.evaluation.status.ok() && result.evaluation.gradient.size() > 0;
  if (!arguments.json && known) print_table(problem, result, console.out);
  Json object = result_json(arguments, problem, result, counts);
  add_warnings(arguments, problem, result.evaluation.warnings, &object, console);
  return finish(arguments, result.status, std::move(object), console);
}

}  // namespace codesign::cli
