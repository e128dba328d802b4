// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembly.h"

#include "assembly/assembly_parts.h"
#include "assembly/loop_turns.h"
#include "assembly/start_motion.h"
#include "equations/compiled_system.h"

namespace codesign {

Assembly::Parts::Parts(const CompiledSystem& compiled)
    : loops(compiled),
      first(loops),
      closure(loops),
      positions(loops, &closure),
      branch(loops, first.own_design(), &closure.newton()),
      velocities(loops),
      singular(compiled, loops.tree, loops.jacobian),
      stuck(compiled),
      list(loops, &first, &closure, &positions),
      rates(compiled) {
  posture.given = loops.given;
}

Assembly::Assembly(const CompiledSystem& system) : parts_(std::make_unique<Parts>(system)) {}

Assembly::~Assembly() = default;

void Assembly::begin_at(double time, const VectorX<double>& theta) {
  parts_->first.begin_at(time, theta);
}
RateSolution& Assembly::rates() { return parts_->rates; }
const RateSolution& Assembly::rates() const { return parts_->rates; }
const VectorX<double>& Assembly::theta() const { return parts_->posture.theta; }
const TreeLayout& Assembly::tree() const { return parts_->loops.tree; }
const Warnings& Assembly::warnings() const { return parts_->warnings; }
const std::vector<std::size_t>& Assembly::contradicting() const { return parts_->contradicting; }
const LoopMiss& Assembly::worst_miss() const { return parts_->posture.miss; }
const LoopJacobian& Assembly::loops() const { return parts_->loops.jacobian; }

void Assembly::obey(const std::atomic<bool>* cancel) {
  parts_->cancel = cancel;
  parts_->rates.obey(cancel);
}

void Assembly::Parts::forget_messages() {
  warnings.clear();
  contradicting.clear();
}

Status Assembly::solve_positions(const std::vector<double>& parameters,
                                 Equations<double>* equations, State<double>* state) {
  Parts& parts = *parts_;
  Posture& posture = parts.posture;
  const StartDesign design = parts.design(parameters, equations);
  parts.forget_messages();
  parts.rates.reset_pivots();
  posture.number = 0.0;
  posture.time = parts.first.time();
  state->resize(parts.loops.system.layout());
  state->t = posture.time;
  set_extra_states(parts.loops.system, parameters, &state->s);
  parts.first.set(parameters, &posture);
  parts.loops.followers.follow(*equations, &posture);
  Status status = parts.positions.find(design, &parts.first, &posture, &parts.warnings);
  if (parts.first.is_own(parameters)) {
    if (status.ok()) parts.branch.begin(posture);
  } else if (parts.branch.is_known() && !parts.first.has_guess()) {
    status = parts.branch.keep(status, design, &posture, &parts.warnings);
  }
  follow_gears(parts.loops.tree, &posture);
  if (status.ok()) place(parts.loops, design, posture, &parts.links, state);
  return status;
}

Status Assembly::solve_velocities(const std::vector<double>& parameters,
                                  Equations<double>* equations, State<double>* state) {
  Parts& parts = *parts_;
  Posture& posture = parts.posture;
  const StartDesign design = parts.design(parameters, equations);
  if (Status status =
          parts.velocities.find(design, &posture, &parts.dependents, &parts.contradicting);
      !status.ok())
    return status;
  const Status motion =
      choose_motion(parts.loops, design, &posture, &parts.singular, &parts.warnings);
  follow_gears(parts.loops.tree, &posture);
  place(parts.loops, design, posture, &parts.links, state);
  return motion.ok() ? parts.stuck.require_rest(*state, equations, &parts.contradicting) : motion;
}

Status Assembly::solve_motion(const std::vector<double>& parameters, Equations<double>* equations,
                              State<double>* state) {
  const Status status = solve_positions(parameters, equations, state);
  return status.ok() ? solve_velocities(parameters, equations, state) : status;
}

Status Assembly::solve(const std::vector<double>& parameters, Equations<double>* equations,
                       State<double>* state) {
  if (Status status = solve_motion(parameters, equations, state); !status.ok()) return status;
  equations->begin_states(state);
  Parts& parts = *parts_;
  const Status status = parts.stuck.hold(equations, state, &parts.rates, &parts.warnings);
  return status.ok() ? require_motion(parts.loops, parts.posture, *state, &parts.singular) : status;
}

Status Assembly::Parts::close_from(const TreeCoordinates& from, const StartDesign& design,
                                   Posture* sought) {
  forget_messages();
  rates.reset_pivots();
  sought->theta = from.theta;
  sought->rate = from.rate;
  loops.followers.follow(*design.equations, sought);
  const Status status = positions.find(design, &first, sought, &warnings);
  return status.ok() ? velocities.find(design, sought, &dependents, &contradicting) : status;
}

// A start may give more positions than the mechanism has freedoms, if they happen to fit. They fit
// no other dimensions, so that a second attempt holds none.
Status Assembly::solve_from(const TreeCoordinates& from, const std::vector<double>& parameters,
                            Equations<double>* equations, State<double>* state) {
  Parts& parts = *parts_;
  const StartDesign design = parts.design(parameters, equations);
  const std::vector<bool> none(to_index(parts.loops.tree.size), false);
  Posture sought = parts.posture;
  sought.given.guess = sought.given.velocity = none;
  sought.time = state->t;
  Status status = parts.close_from(from, design, &sought);
  if (!status.ok() && sought.given.position != none) {
    sought.given.position = none;
    status = parts.close_from(from, design, &sought);
  }
  parts.posture.miss = sought.miss;
  if (!status.ok()) {
    status.time = state->t;
    return status;
  }
  sought.given = parts.loops.given;
  parts.posture = sought;
  const std::vector<double> turns = state->turns;
  place(parts.loops, design, sought, &parts.links, state);
  keep_loop_turns(parts.loops.system, turns, state);
  return {};
}

}  // namespace codesign
