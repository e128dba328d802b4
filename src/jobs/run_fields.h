// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "jobs/effort_recorder.h"
#include "jobs/fields.h"
#include "jobs/near_links.h"
#include "jobs/run_recorder.h"
#include "linear/linear_model.h"
#include "linear/loop_margins.h"
#include "linear/state_space.h"
#include "mechanism/machine_numbers.h"
#include "mechanism_codesign/counts.h"
#include "mechanism_codesign/event.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

// The tables of results, in the order of documents: of runs and of linearizations.

constexpr auto fields_of(const Statistics*) {
  return std::make_tuple(
      field("steps", &Statistics::steps, "steps taken; in a search the sum over all evaluations"),
      field("rejected_steps", &Statistics::rejected_steps, "steps that the error test rejected"),
      field("explicit_steps", &Statistics::explicit_steps, "steps of the explicit pair among them"),
      field("cpu_seconds", &Statistics::cpu_seconds, "processor time [s]").finite(),
      field("constraint_drift", &Statistics::constraint_drift,
            "largest violation of the constraints after a step, in error tolerances; in a search "
            "the largest of any evaluation"),
      field("energy_error", &Statistics::energy_error,
            "largest error of the energy balance, relative to the energies that are exchanged"));
}

constexpr auto fields_of(const Warning*) {
  return std::make_tuple(
      field("code", &Warning::code, "code of doc/warnings.md"),
      field("message", &Warning::message, "the sentence that the terminal shows"),
      field(
          "file", [](auto& warning) -> auto& { return warning.where.file; },
          "that it is about, empty without one"),
      field(
          "line", [](auto& warning) -> auto& { return warning.where.line; }, "0 if it has none"));
}

constexpr auto fields_of(const Event*) {
  return std::make_tuple(
      field("time", &Event::time, "of the switch, where a step ends [s]").finite(),
      field("element", &Event::element,
            "its place in the study, such as loads[0].effort or objective.integral[0].signal, or "
            "the joint of a stop or of Gonthier's friction"),
      field("object", &Event::object, "joint or link on which the element acts; empty: none"),
      field("expression", &Event::expression,
            "the comparison or function as the study has it, or the law's guard in words"),
      word("direction", &Event::rising, "falling", "rising",
           "rising: the comparison becomes true, the argument rises, a later argument of min or "
           "max takes over, or a stop is touched"),
      word("kind", &Event::jump, "kink", "jump",
           "jump: accelerations, reactions or the integrand of the objective jump; kink: they are "
           "continuous"));
}

constexpr auto fields_of(const ConstraintRow*) {
  return std::make_tuple(
      field("joint", &ConstraintRow::joint, "joint, loop, coupling or body of the row"),
      field("row", &ConstraintRow::row, "number within it, from 1"),
      field("kind", &ConstraintRow::kind,
            "which two vectors the row keeps normal, or which points it keeps together"));
}

constexpr auto fields_of(const Counts*) {
  return std::make_tuple(
      field("bodies", &Counts::bodies, "without the ground"),
      field("coordinates", &Counts::coordinates, "n, 7 for each body"),
      field("first_order_equations", &Counts::first_order_equations, "2 n"),
      field("controller_states", &Counts::controller_states,
            "integrals and filters of controllers and states of friction, beside the equations "
            "below"),
      field("degrees_of_freedom", &Counts::degrees_of_freedom, "dimension of the possible motions"),
      field("constraints", &Counts::constraints, "m, rows of the constraints"),
      field("redundant_constraints", &Counts::redundant_constraints,
            "rows that depend on the others"),
      field("dynamic_equations", &Counts::dynamic_equations, "2 n + m"),
      field("parameters", &Counts::parameters, "tuned parameters"),
      field("sensitivities", &Counts::sensitivities, "parameters · (2 n + m)"),
      field("total_equations", &Counts::total_equations, "dynamic equations and sensitivities"),
      word("solved_in", &Counts::in_joint_coordinates, "absolute", "joint",
           "coordinates of the equations that are solved"),
      field("solved_coordinates", &Counts::solved_coordinates,
            "coordinates of the equations that are solved"),
      field("solved_constraints", &Counts::solved_constraints, "their constraint rows"),
      field("redundant_rows", &Counts::redundant_rows,
            "rows that depend on the other rows at the start"),
      field("undetermined_reactions", &Counts::undetermined_reactions,
            "joints whose reactions are not unique; those of least norm are used"),
      field("chosen_friction", &Counts::chosen_friction,
            "joints whose friction depends on such a reaction"));
}

constexpr auto fields_of(const LimitCrossing*) {
  return std::make_tuple(field("joint", &LimitCrossing::joint, "whose limit it is"),
                         field("limit", &LimitCrossing::limit, "which limit"),
                         field("bound", &LimitCrossing::bound, "the limit"),
                         field("worst", &LimitCrossing::worst, "the value farthest beyond it"),
                         field("time", &LimitCrossing::time, "when [s]").finite());
}

constexpr auto fields_of(const MachineNumber*) {
  return std::make_tuple(field("joint", &MachineNumber::joint, "whose number it is"),
                         field("number", &MachineNumber::number, "which one"),
                         field("value", &MachineNumber::value, "in the unit beside it"),
                         field("unit", &MachineNumber::unit, "of the value"));
}

constexpr auto fields_of(const NearLinks*) {
  return std::make_tuple(
      field("first", &NearLinks::first, "a link"),
      field("second", &NearLinks::second, "another one"),
      field("distance", &NearLinks::distance,
            "of the boxes about their shapes, at least [m]; 0 where they overlap")
          .finite());
}

/// Without radius, which a period gives, and rates.
constexpr auto fields_of(const LinearMode*) {
  return std::make_tuple(
      field(
          "growth", [](const LinearMode& mode) { return mode.pole.growth(); },
          "real part of the pole [1/s]; negative: it decays"),
      field(
          "frequency", [](const LinearMode& mode) { return mode.pole.frequency(); }, "[Hz]"),
      field(
          "damping_ratio", [](const LinearMode& mode) { return mode.pole.damping_ratio(); },
          "negative: it grows"));
}

/// From when on which method took the steps.
constexpr auto fields_of(const MethodChange*) {
  return std::make_tuple(
      field("from", &MethodChange::time, "[s]").finite(),
      field("method", &MethodChange::method, "of integration, from that time on"));
}

/// Of the efforts of a drive.
constexpr auto fields_of(const Extreme*) {
  return std::make_tuple(
      field("value", &Extreme::value,
            "of largest magnitude; null if infinite: the mechanism locks"),
      field("at", &Extreme::at, "the instant [s], or the posture in the order of the grid"));
}

/// Without the period.
constexpr auto fields_of(const StateSpace*) {
  return std::make_tuple(
      field("states", &StateSpace::states,
            "coordinates and their rates, then states of controllers and friction"),
      field("inputs", &StateSpace::inputs, "set-points, references, disturbances, loads"),
      field("outputs", &StateSpace::outputs, "the signals of --signals"),
      field("A", &StateSpace::A, "x' = A x + B u; with a period from one to the next"),
      field("B", &StateSpace::B, "one row per state, one column per input"),
      field("C", &StateSpace::C, "one row per output, one column per state"),
      field("D", &StateSpace::D, "one row per output, one column per input"));
}

constexpr auto fields_of(const AtFrequency*) {
  return std::make_tuple(field("value", &AtFrequency::value, "of the margin"),
                         field("frequency", &AtFrequency::frequency, "at which it occurs [rad/s]"));
}

}  // namespace codesign
