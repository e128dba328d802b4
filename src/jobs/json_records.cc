// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/json_records.h"

#include "assembly/count_equations.h"
#include "jobs/json.h"

namespace codesign {
namespace {

Json to_json(const std::vector<ConstraintRow>& rows) {
  Json array = Json::array();
  for (const ConstraintRow& row : rows) array.push_back({{"joint", row.joint}, {"row", row.row}, {"kind", row.kind}});
  return array;
}

}  // namespace

Json to_json(const Counts& counts) {
  return {{"bodies", counts.bodies},
          {"coordinates", counts.coordinates},
          {"first_order_equations", counts.first_order_equations},
          {"controller_states", counts.controller_states},
          {"degrees_of_freedom", counts.degrees_of_freedom},
          {"constraints", counts.constraints},
          {"redundant_constraints", counts.redundant_constraints},
          {"dynamic_equations", counts.dynamic_equations},
          {"parameters", counts.parameters},
          {"sensitivities", counts.sensitivities},
          {"total_equations", counts.total_equations},
          {"solved_in", counts.in_joint_coordinates ? "joint" : "absolute"},
          {"solved_coordinates", counts.solved_coordinates},
          {"solved_constraints", counts.solved_constraints},
          {"redundant_rows", to_json(counts.redundant_rows)},
          {"undetermined_reactions", counts.undetermined_reactions},
          {"chosen_friction", counts.chosen_friction}};
}

Json to_json(const InputError& error) {
  const InputFault& fault = error.fault();
  return {{"code", "bad_input"},      {"message", error.what()}, {"file", fault.where.file}, {"line", fault.where.line},
          {"element", fault.element}, {"value", fault.value},    {"allowed", fault.allowed}};
}

Json to_json(const std::vector<LimitCrossing>& crossings) {
  Json array = Json::array();
  for (const LimitCrossing& c : crossings)
    array.push_back({{"joint", c.joint}, {"limit", c.limit}, {"bound", c.bound}, {"worst", c.worst}, {"time", c.time}});
  return array;
}

Json to_json(const Status& status) { return {{"code", name_of(status.code)}, {"message", status.cause}, {"time", status.time}}; }

Json to_json(const Warnings& warnings) {
  Json array = Json::array();
  for (const Warning& warning : warnings)
    array.push_back({{"code", warning.code}, {"message", warning.message}, {"file", warning.where.file}, {"line", warning.where.line}});
  return array;
}

void add_statistics(const Statistics& statistics, Json* object) {
  (*object)["steps"] = statistics.steps;
  (*object)["rejected_steps"] = statistics.rejected_steps;
  (*object)["explicit_steps"] = statistics.explicit_steps;
  (*object)["cpu_seconds"] = statistics.cpu_seconds;
  (*object)["constraint_drift"] = statistics.constraint_drift;
  (*object)["energy_error"] = statistics.energy_error;
}

void add_outcome(const Problem& problem, const Warnings& of_run, const Status& status, Json* object) {
  Warnings warnings = problem.warnings();
  append(of_run, &warnings);
  (*object)["setup_seconds"] = problem.setup_seconds();
  (*object)["warnings"] = to_json(warnings);
  if (!status.ok()) (*object)["error"] = to_json(status);
}

void add_counts(const Problem& problem, const std::vector<double>& parameters, Json* object) {
  Status status;
  const Counts counts = count_equations(*problem.system(), parameters, &status);
  if (status.ok()) (*object)["counts"] = to_json(counts);
}

}  // namespace codesign
