// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Assembly that goes from posture to posture, doc/theory.md (21f).
#include "assembly/assembly_parts.h"
#include "assembly/loop_turns.h"
#include "equations/compiled_system.h"

namespace codesign {
namespace {

constexpr double kUndetermined = 1e12;  // larger unknowns follow from a pivot that is rounding

}  // namespace

Status Assembly::solve_next(const std::vector<double>& parameters, Equations<double>* equations,
                            State<double>* state) {
  Parts& parts = *parts_;
  Posture& posture = parts.posture;
  const CompiledSystem& system = parts.loops.system;
  const StartDesign design = parts.design(parameters, equations);
  parts.forget_messages();
  parts.rates.reset_pivots();
  if (posture.number == 0.0) parts.list.begin(design, posture, *state);
  State<double> counted = *state;
  Status found = parts.list.go_on(design, &posture, &counted, &parts.warnings);
  state->t = posture.time;
  if (!found.ok()) return found;
  const bool is_singular = parts.list.is_singular(design, posture);
  set_extra_states(system, parameters, &state->s);
  state->z.setZero();
  if (Status status = solve_velocities(parameters, equations, state); !status.ok()) return status;
  set_turns(system, parts.loops.tree, posture.theta, state);
  keep_loop_turns(system, counted.turns, state);
  equations->track_turns(state);
  Status status = parts.rates.solve(equations, state);
  parts.list.add(posture, *state, is_singular);
  if (!is_singular) return status;
  const bool has_forces = status.ok() && state->z.cwiseAbs().maxCoeff() < kUndetermined;
  if (!has_forces) state->z.setZero();
  parts.list.warn_of_singular(parameters, posture.number, has_forces, &parts.warnings);
  return {};
}

}  // namespace codesign
