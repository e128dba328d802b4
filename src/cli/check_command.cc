// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include "assembly/count_equations.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/recordings.h"
#include "cli/report.h"
#include "description/study.h"
#include "integration/simulation_of.h"
#include "jobs/near_links.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "jobs/run_recorder.h"
#include "jobs/setpoint_bounds.h"
#include "mechanism/machine_numbers.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "reading/urdf/foreign_contacts.h"
#include "reading/urdf/pictures.h"
#include "reading/urdf/starting_overlay.h"
#include "reading/urdf/urdf_reader.h"
#include "text/number_text.h"
#include "text/table.h"

namespace codesign::cli {
namespace {

void print_names(const std::string& what, const std::vector<std::string>& names,
                 std::ostream& out) {
  if (names.empty()) return;
  out << what << '\n';
  for (const std::string& name : names) out << "  " << name << '\n';
}

void print_redundancy(const Counts& counts, std::ostream& out) {
  std::vector<std::string> rows;
  rows.reserve(counts.redundant_rows.size());
  for (const ConstraintRow& row : counts.redundant_rows)
    rows.push_back(row.joint + ", row " + std::to_string(row.row) + ": " + row.kind);
  print_names("redundant rows (they depend on the other rows at the start)", rows, out);
  print_names("reactions that are not unique; those of least norm are used",
              counts.undetermined_reactions, out);
  print_names("friction that depends on such a reaction", counts.chosen_friction, out);
}

void print_table(const Counts& counts, std::ostream& out) {
  Table table;
  const auto add = [&table](const char* what, int number) {
    table.add({what, std::to_string(number)});
  };
  add("bodies", counts.bodies);
  add("coordinates", counts.coordinates);
  add("first-order equations", counts.first_order_equations);
  if (counts.controller_states > 0)
    add("additional controller and friction states", counts.controller_states);
  add("degrees of freedom", counts.degrees_of_freedom);
  add("constraints", counts.constraints);
  add("redundant constraints", counts.redundant_constraints);
  add("dynamic equations", counts.dynamic_equations);
  add("parameters", counts.parameters);
  add("sensitivities", counts.sensitivities);
  add("equations in all", counts.total_equations);
  table.print(out);
  out << "solved in " << (counts.in_joint_coordinates ? "joint" : "absolute")
      << " coordinates: " << counts.solved_coordinates << ", with " << counts.solved_constraints
      << " constraints\n";
  print_redundancy(counts, out);
}

void print_numbers(const std::vector<MachineNumber>& numbers, std::ostream& out) {
  std::vector<std::string> rows;
  rows.reserve(numbers.size());
  for (const MachineNumber& n : numbers)
    rows.push_back(n.joint + ", " + n.number + ": " + readable(n.value, 3) + " " + n.unit);
  print_names("numbers that are not given and follow the machine", rows, out);
}

/// What the start shows.
struct StartReport {
  std::vector<LimitCrossing> crossings;  ///< limits that it exceeds
  std::vector<NearLinks> near;
};

/// @param warnings those of the start are appended.
StartReport look_at_start(const Problem& problem, const std::vector<double>& parameters,
                          Warnings* warnings) {
  Simulation simulation = simulation_of(system_of(problem), parameters);
  LimitWatch watch(problem, parameters, simulation.names());
  Frame frame;
  if (!simulation.start().ok()) return {};
  append(simulation.warnings(), warnings);
  simulation.sample(0.0, &frame);
  watch.observe(frame);
  return {watch.crossings(), find_near_links(problem, parameters, simulation.names().links, frame)};
}

void print_near(const std::vector<NearLinks>& near, std::ostream& out) {
  std::vector<std::string> rows;
  rows.reserve(near.size());
  for (const NearLinks& links : near)
    rows.push_back(links.first + " and " + links.second + ": " +
                   (links.distance > 0.0 ? readable(1e3 * links.distance, 3) + " mm apart"
                                         : "the boxes overlap"));
  print_names(
      "links whose <collision> are near each other at the start; they pass through each other, "
      "since no <codesign:contact> lets them touch",
      rows, out);
}

}  // namespace

int check(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments, &console);
  const std::vector<double> parameters = problem.parameters();
  Status status;
  const Counts counts = count_equations(*system_of(problem), parameters, &status);
  Warnings warnings;
  const StartReport start = look_at_start(problem, parameters, &warnings);
  append(find_foreign_contacts(problem.urdf(), problem.overlays(), robot_of(problem)), &warnings);
  const std::vector<MachineNumber> numbers = machine_numbers_of(problem, parameters);
  const std::vector<RecordingSummary> recordings = check_recordings(problem, console, &warnings);
  if (status.ok())
    append(find_bounds_beyond_setpoints(problem, parameters, &console.cancel), &warnings);
  if (!arguments.json && status.ok()) {
    print_table(counts, console.out);
    print_numbers(numbers, console.out);
    print_near(start.near, console.out);
    for (const LimitCrossing& crossing : start.crossings) console.out << describe(crossing) << '\n';
    print_recordings(recordings, console.out);
  }
  Json object;
  object["model"] = robot_of(problem).name;
  object["parameters"] = parameters_json(problem, parameters);
  if (status.ok()) object["counts"] = record_json(counts);
  object["limits_exceeded"] = to_json(start.crossings);
  object["near_links"] = records_json(start.near);
  object["machine_numbers"] = to_json(numbers);
  if (study_of(problem).identification) object["recordings"] = to_json(recordings);
  add_warnings(arguments, problem, warnings, &object, console);
  return finish(arguments, status, std::move(object), console);
}

int urdf(const Arguments& arguments, const Console& console) {
  const Problem problem = load(arguments);
  std::string text = write_tuned_urdf(problem.urdf(), problem.overlays(), problem.parameters(),
                                      std::nullopt, robot_of(problem).laws);
  if (arguments.sticks) text = with_sticks(text);
  if (!arguments.json) console.out << text;
  Json object;
  object["model"] = robot_of(problem).name;
  object["parameters"] = parameters_json(problem, problem.parameters());
  object["urdf"] = text;
  add_warnings(arguments, problem, {}, &object, console);
  return finish(arguments, Status(), std::move(object), console);
}

int overlay(const Arguments& arguments, const Console& console) {
  const SourceText model = read_source(arguments.model);
  std::vector<SourceText> overlays;
  for (const std::string& path : arguments.overlays) overlays.push_back(read_source(path));
  const RobotDescription robot = read_urdf(model, overlays);
  const std::string text = starting_overlay(model, overlays);
  if (!arguments.json) console.out << text;
  print_warnings(arguments, robot.warnings, console);
  Json object;
  object["model"] = robot.name;
  object["overlay"] = text;
  object["warnings"] = to_json(robot.warnings);
  return finish(arguments, Status(), std::move(object), console);
}

}  // namespace codesign::cli
