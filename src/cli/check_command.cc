// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/report.h"
#include "cli/table.h"

namespace codesign::cli {
namespace {

void print_table(const Counts& counts, std::ostream& out) {
  Table table;
  const auto add = [&table](const char* what, int number) { table.add({what, std::to_string(number)}); };
  add("bodies", counts.bodies);
  add("coordinates", counts.coordinates);
  add("first-order equations", counts.first_order_equations);
  if (counts.controller_states > 0) add("controller and friction states beside them", counts.controller_states);
  add("degrees of freedom", counts.degrees_of_freedom);
  add("constraints", counts.constraints);
  add("redundant constraints", counts.redundant_constraints);
  add("dynamic equations", counts.dynamic_equations);
  add("parameters", counts.parameters);
  add("sensitivities", counts.sensitivities);
  add("equations in all", counts.total_equations);
  table.print(out);
  if (counts.redundant_rows.empty()) return;
  out << "redundant rows (friction computed from their reactions is a choice: the reactions of least norm)\n";
  for (const std::string& row : counts.redundant_rows) out << "  " << row << '\n';
}

}  // namespace

int check(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments);
  const std::vector<double> parameters = problem.parameters();
  Status status;
  const Counts counts = count_equations(problem.system, parameters, &status);
  if (!arguments.json && status.ok()) print_table(counts, console.out);
  Json object;
  object["model"] = problem.robot.name;
  object["parameters"] = parameters_json(problem, parameters);
  if (status.ok()) object["counts"] = to_json(counts);
  return finish(arguments, status, std::move(object), console);
}

}  // namespace codesign::cli
