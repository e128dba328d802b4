// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_replay.h"

#include "text/cancel.h"

namespace codesign {

StepReplay::StepReplay(const CompiledSystem& system, const RosenbrockTableau& tableau,
                       int most_points)
    : step_(system, tableau), path_(system.layout(), most_points) {
  for (State<double>* state : {&point_, &before_, &behind_}) state->resize(system.layout());
}

void StepReplay::start(const RosenbrockIntegrator& run) {
  if (!has_pivots_) step_.keep_pivots_of(run.step());
  has_pivots_ = true;
  path_.clear();
  jumps_.clear();
  path_.append(0.0, run.step().tableau(), run.initial_state(), run.initial_state().t);
}

void StepReplay::store_step(const RosenbrockIntegrator& run) {
  const OneStep<double>& step = run.step();
  path_.append(step.step_size(), step.tableau(), step.unprojected(), step.state().t);
}

void StepReplay::store_jump(const RosenbrockIntegrator& run) {
  jumps_.append(path_.size() - 1, run);
}

void StepReplay::begin(RosenbrockIntegrator* run) {
  assembly_ = &run->assembly();
  step_.equations().set_design(run->equations().parameters());
  step_.equations().hold(jumps_.mode_after(0));
  step_.use(path_.tableau(0));
  step_.start(run->initial_state());
  step_.choose_pivots(path_.size() > 1 ? path_.step_size(1) : run->step().step_size());
}

// Accelerations and multipliers are solved for again, as the run did.
bool StepReplay::carry_over(const RunJump& jump) {
  Equations<double>& equations = step_.equations();
  before_ = behind_ = step_.state();
  if (!jump.events.empty()) equations.jump(jump.events, &behind_);
  equations.hold(jump.mode);
  if (!assembly_->rates().solve(&equations, &behind_).ok()) return false;
  step_.restart(behind_);
  return true;
}

/// Continues the solution at point k, which `point_` holds.
bool StepReplay::take_up(int k) {
  if (k + 1 < path_.size()) step_.use(path_.tableau(k + 1));
  if (!jumps_.is_empty()) step_.equations().hold(jumps_.mode_before(k));
  if (k == 0) {
    step_.start(point_);
  } else if (!step_.resume(point_)) {
    return false;
  }
  step_.set_time(path_.next_start(k));
  // Turn counts follow the nearest previous positions, in the backward pass as well.
  step_.track_turns();
  const RunJump* const jump = jumps_.at(k);
  return !jump || carry_over(*jump);
}

/// Sets `point_` to the k-th point of the path. If it was not stored, the steps from the last
/// stored point before it are repeated.
bool StepReplay::reach(int k, const std::atomic<bool>* cancel) {
  const int from = path_.kept_before(k);
  path_.point(from, &point_);
  if (from == k) return true;
  const int spacing = path_.make_room(from, k);
  for (int at = from; at < k; ++at) {
    if (is_set(cancel)) return false;
    if (!take_up(at) || !step_.attempt(path_.step_size(at + 1))) return false;
    point_ = step_.unprojected();
    if (at + 1 == k || (at + 1 - from) % spacing == 0) path_.keep(at + 1, point_);
  }
  return true;
}

bool StepReplay::repeat(int k, const std::atomic<bool>* cancel) {
  if (!reach(k, cancel) || !take_up(k)) return false;
  return k + 1 == path_.size() || step_.attempt(path_.step_size(k + 1));
}

}  // namespace codesign
