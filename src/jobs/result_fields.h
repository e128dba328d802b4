// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "identification/fit/identification_result.h"
#include "jobs/fields.h"
#include "jobs/run_recorder.h"
#include "jobs/saved_result.h"
#include "linear/linear_model.h"
#include "mechanism/machine_numbers.h"
#include "mechanism_codesign/counts.h"
#include "mechanism_codesign/event.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

// The tables of results, in the order of documents. A new field of a result is a member and a row
// here, and a line of the .msg file if it is to be in a message.

constexpr auto fields_of(const Statistics*) {
  return std::make_tuple(field("steps", &Statistics::steps),
                         field("rejected_steps", &Statistics::rejected_steps),
                         field("explicit_steps", &Statistics::explicit_steps),
                         field("cpu_seconds", &Statistics::cpu_seconds),
                         field("constraint_drift", &Statistics::constraint_drift),
                         field("energy_error", &Statistics::energy_error));
}

constexpr auto fields_of(const Warning*) {
  return std::make_tuple(field("code", &Warning::code), field("message", &Warning::message),
                         field(
                             "file", [](auto& warning) -> auto& { return warning.where.file; }),
                         field(
                             "line", [](auto& warning) -> auto& { return warning.where.line; }));
}

constexpr auto fields_of(const Event*) {
  return std::make_tuple(field("time", &Event::time), field("element", &Event::element),
                         field("object", &Event::object), field("expression", &Event::expression),
                         word("direction", &Event::rising, "falling", "rising"),
                         word("kind", &Event::jump, "kink", "jump"));
}

constexpr auto fields_of(const ConstraintRow*) {
  return std::make_tuple(field("joint", &ConstraintRow::joint), field("row", &ConstraintRow::row),
                         field("kind", &ConstraintRow::kind));
}

constexpr auto fields_of(const Counts*) {
  return std::make_tuple(
      field("bodies", &Counts::bodies), field("coordinates", &Counts::coordinates),
      field("first_order_equations", &Counts::first_order_equations),
      field("controller_states", &Counts::controller_states),
      field("degrees_of_freedom", &Counts::degrees_of_freedom),
      field("constraints", &Counts::constraints),
      field("redundant_constraints", &Counts::redundant_constraints),
      field("dynamic_equations", &Counts::dynamic_equations),
      field("parameters", &Counts::parameters), field("sensitivities", &Counts::sensitivities),
      field("total_equations", &Counts::total_equations),
      word("solved_in", &Counts::in_joint_coordinates, "absolute", "joint"),
      field("solved_coordinates", &Counts::solved_coordinates),
      field("solved_constraints", &Counts::solved_constraints),
      field("redundant_rows", &Counts::redundant_rows),
      field("undetermined_reactions", &Counts::undetermined_reactions),
      field("chosen_friction", &Counts::chosen_friction));
}

constexpr auto fields_of(const LimitCrossing*) {
  return std::make_tuple(
      field("joint", &LimitCrossing::joint), field("limit", &LimitCrossing::limit),
      field("bound", &LimitCrossing::bound), field("worst", &LimitCrossing::worst),
      field("time", &LimitCrossing::time));
}

constexpr auto fields_of(const MachineNumber*) {
  return std::make_tuple(
      field("joint", &MachineNumber::joint), field("number", &MachineNumber::number),
      field("value", &MachineNumber::value), field("unit", &MachineNumber::unit));
}

/// Without the values that run and sample set, whose names differ.
constexpr auto fields_of(const ScenarioResult*) {
  return std::make_tuple(field("run", &ScenarioResult::run),
                         field("sample", [](const ScenarioResult& one) { return one.sample + 1; }),
                         field("weight", &ScenarioResult::weight),
                         field("initial_objective", &ScenarioResult::initial_objective),
                         field("objective", &ScenarioResult::objective),
                         field("initial_failed", &ScenarioResult::initial_failed),
                         field("failed", &ScenarioResult::failed),
                         field("friction_law", [](const ScenarioResult& one) {
                           return unless_empty(one.friction_law);
                         }));
}

constexpr auto fields_of(const Validation*) {
  return std::make_tuple(
      field("samples", &Validation::samples), field("failed", &Validation::failed),
      field("promised", &Validation::promised), field("objective", &Validation::objective),
      field("mean", &Validation::mean), field("worst", &Validation::worst),
      field("value_at_risk", &Validation::value_at_risk), field("within", &Validation::within));
}

/// Without the design.
constexpr auto fields_of(const Optimum*) {
  return std::make_tuple(field("objective", &Optimum::objective), field("found", &Optimum::found));
}

/// Without the designs.
constexpr auto fields_of(const StartResult*) {
  return std::make_tuple(
      field("start_objective", &StartResult::start_objective),
      field("objective", &StartResult::objective),
      field("status", [](const StartResult& one) { return name_of(one.status.code); }),
      field("termination", &StartResult::termination),
      field("evaluations", &StartResult::evaluations),
      field("optimum", [](const StartResult& one) { return one.optimum + 1; }));
}

constexpr auto fields_of(const SearchCost*) {
  return std::make_tuple(field("iterations", &SearchCost::iterations),
                         field("evaluations", &SearchCost::evaluations),
                         field("failed_evaluations", &SearchCost::failed_evaluations));
}

/// Without what was chosen.
constexpr auto fields_of(const ChoiceResult*) {
  return std::make_tuple(
      field("combinations", &ChoiceResult::combinations),
      field("searched", &ChoiceResult::searched), field("unfinished", &ChoiceResult::unfinished),
      field("relaxations", &ChoiceResult::relaxations), field("bounded", &ChoiceResult::bounded),
      field("infeasible", &ChoiceResult::infeasible),
      field("complete", &ChoiceResult::is_complete));
}

constexpr OrNull bound_or_null(double bound) { return {bound, !std::isfinite(bound)}; }

/// Without the scenarios of the smallest and the largest value.
constexpr auto fields_of(const WatchedResult*) {
  return std::make_tuple(
      field("element", &WatchedResult::element), field("signal", &WatchedResult::signal),
      field("lower", [](const WatchedResult& one) { return bound_or_null(one.lower); }),
      field("upper", [](const WatchedResult& one) { return bound_or_null(one.upper); }),
      field("after", &WatchedResult::after), field("before", &WatchedResult::before),
      field("initial_smallest", &WatchedResult::initial_smallest),
      field("initial_largest", &WatchedResult::initial_largest),
      field("smallest", &WatchedResult::smallest), field("largest", &WatchedResult::largest),
      field("smallest_time", &WatchedResult::smallest_time),
      field("largest_time", &WatchedResult::largest_time),
      field("violation", &WatchedResult::violation), field("tolerance", &WatchedResult::tolerance));
}

/// A number of the interval, which a number on a bound does not have.
inline OrNull interval_number(const IdentifiedNumber& of, double value) {
  return {of.is_on_bound ? std::numeric_limits<double>::quiet_NaN() : value, of.is_on_bound};
}

/// Without bounds and intervals.
constexpr auto fields_of(const IdentifiedNumber*) {
  return std::make_tuple(
      field("value", &IdentifiedNumber::value), field("start", &IdentifiedNumber::start),
      field("unit", &IdentifiedNumber::unit), field("determined", &IdentifiedNumber::is_determined),
      field("on_bound", &IdentifiedNumber::is_on_bound),
      field("deviation",
            [](const IdentifiedNumber& one) { return interval_number(one, one.deviation); }));
}

constexpr auto fields_of(const BaseParameter*) {
  return std::make_tuple(field("expression", &BaseParameter::expression),
                         field("value", &BaseParameter::value),
                         field("deviation", &BaseParameter::deviation),
                         field("interval", [](const BaseParameter& one) {
                           return std::array<double, 2>{one.low, one.high};
                         }));
}

/// Without joint and whiteness.
constexpr auto fields_of(const OutputFit*) {
  return std::make_tuple(
      field("recorded_rms", &OutputFit::recorded), field("start_rms", &OutputFit::start),
      field("rms", &OutputFit::rms), field("worst", &OutputFit::worst),
      field("explained", &OutputFit::explained), field("counted", &OutputFit::counted));
}

constexpr auto fields_of(const Whiteness*) {
  return std::make_tuple(field("ljung_box", &Whiteness::statistic), field("lags", &Whiteness::lags),
                         field("probability", &Whiteness::probability),
                         field("first_correlation", &Whiteness::first_correlation));
}

constexpr auto fields_of(const IdentificationResult*) {
  return std::make_tuple(field("termination", &IdentificationResult::termination),
                         field("evaluations", &IdentificationResult::evaluations),
                         field("failed_evaluations", &IdentificationResult::failed_evaluations),
                         field("iterations", &IdentificationResult::iterations),
                         field("cpu_seconds", &IdentificationResult::cpu_seconds));
}

/// Without radius, which a period gives, and rates.
constexpr auto fields_of(const LinearMode*) {
  return std::make_tuple(
      field("growth", [](const LinearMode& mode) { return mode.pole.growth(); }),
      field("frequency", [](const LinearMode& mode) { return mode.pole.frequency(); }),
      field("damping_ratio", [](const LinearMode& mode) { return mode.pole.damping_ratio(); }));
}

constexpr auto fields_of(const ApplyRecord::Change*) {
  return std::make_tuple(
      field("server", &ApplyRecord::Change::server), field("name", &ApplyRecord::Change::name),
      field("before", &ApplyRecord::Change::before), field("after", &ApplyRecord::Change::after),
      field("now", &ApplyRecord::Change::now));
}

}  // namespace codesign
