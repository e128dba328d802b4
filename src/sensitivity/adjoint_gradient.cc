// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_gradient.h"

#include <algorithm>
#include <limits>

#include "math/arrays.h"
#include "text/cancel.h"

namespace codesign {

AdjointGradient::Backward::Backward(const CompiledSystem& system, const RosenbrockTableau& tableau,
                                    int most_points)
    : replay(system, tableau, most_points),
      adjoint(system, tableau),
      jumps(system),
      boundary(system) {
  final_adjoint.setZero(IncrementLayout(system.layout()).size());
}

AdjointGradient::AdjointGradient(const CompiledSystem& system, int most_points)
    : system_(system),
      most_points_(most_points),
      integrator_(system),
      end_(system),
      one_sided_(system) {
  judge_ = [this](OneStep<double>* step) { return control_->attempt(step); };
}

// The workspace of the backward pass is allocated only when a gradient is requested.
Status AdjointGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  with_gradient_ = derivatives != Derivatives::kNone;
  one_sided_.start();
  integrator_.watch_singularities(with_gradient_);
  Status status = integrator_.start(parameters);
  if (!status.ok() || !with_gradient_) return status;
  if (!back_) {
    back_.emplace(system_, integrator_.step().tableau(), most_points_);
    control_ = make_control_tangent(system_);
  }
  control_->start(parameters, &integrator_);
  back_->replay.start(integrator_);
  one_sided_.look_at_start(
      &integrator_, [this](int guard, Eigen::VectorXd* by) { differentiate_guard(guard, by); });
  return status;
}

Status AdjointGradient::jump() {
  Status status = integrator_.jump();
  if (!status.ok() || !integrator_.has_jumped()) return status;
  control_->jump(&integrator_);
  back_->replay.store_jump(integrator_);
  return status;
}

// A jump at the beginning of a step may end the run.
Status AdjointGradient::advance(double limit) {
  if (!with_gradient_) return integrator_.advance(limit);
  if (Status status = jump(); !status.ok() || integrator_.is_ended()) return status;
  Status status = integrator_.advance(limit, judge_);
  if (!status.ok()) return status;
  control_->accept(integrator_.step());
  back_->replay.store_step(integrator_);
  return status;
}

double AdjointGradient::objective() {
  return integrator_.of_losses(integrator_.psi(),
                               integrator_.equations().terminal(integrator_.state()));
}

bool AdjointGradient::look_at_end() {
  end_.start();
  if (!has_moving_end(system_.study()) || !integrator_.has_ended()) return true;
  const std::vector<double>& parameters = integrator_.equations().parameters();
  Eigen::VectorXd time = duration_gradient(system_.study(), parameters);
  if (integrator_.is_ended()) time.setZero();
  if (!end_.evaluate(&integrator_, time).ok()) return false;
  return integrator_.end_guard() < 0 ||
         integrator_.judge_end(integrator_.guard_rate(end_.state(), end_.rates())).ok();
}

// The adjoint of the last state, and 1 for psi.
void AdjointGradient::take_terminal(const State<double>& end) {
  const IncrementLayout at(system_.layout());
  VectorX<double>& adjoint = back_->final_adjoint;
  integrator_.equations().terminal_gradient(end, &back_->terminal);
  adjoint.setZero();
  adjoint[at.psi()] = 1.0;
  for (const auto& e : back_->terminal.position) adjoint[at.x() + e.column] += e.value;
  for (const auto& e : back_->terminal.velocity) adjoint[at.v() + e.column] += e.value;
  for (const auto& e : back_->terminal.rate) adjoint[at.z() + e.column] += e.value;
  back_->jumps.start(integrator_.equations().parameters());
}

// The backward pass begins at the end of the run, and with the guard that ended it.
void AdjointGradient::prepare() {
  take_terminal(integrator_.state());
  if (const int guard = integrator_.end_guard(); end_.moves() && guard >= 0) {
    const double rate = integrator_.guard_rate(end_.state(), end_.rates());
    back_->jumps.add_guard(guard, -end_.objective_rate() / rate, integrator_.state(),
                           integrator_.mode(), &back_->final_adjoint);
  }
}

bool AdjointGradient::jump_back(const RunJump& jump, int k) {
  const bool ends_run = k + 1 == back_->replay.size() && integrator_.is_ended();
  return back_->jumps.reverse(jump, back_->replay.before(), back_->replay.behind(),
                              back_->replay.mode_before(k), ends_run ? end_.objective_rate() : 0.0,
                              &back_->adjoint.adjoint());
}

// The step that begins at point k, the jump there, and the projection with which it begins. Behind
// a jump the matrices of the step are those of the state there.
bool AdjointGradient::step_back(int k) {
  StepReplay& replay = back_->replay;
  AdjointStep& adjoint = back_->adjoint;
  if (!replay.repeat(k, cancel_)) return false;
  const RunJump* const jump = replay.jump(k);
  const bool has_stages = k + 1 < replay.size();
  adjoint.clear();
  adjoint.hold(replay.mode_after(k));
  if (has_stages) adjoint.reverse_stages(&replay.step());
  if (jump) {
    adjoint.reverse_matrices(replay.behind());
    if (!jump_back(*jump, k)) return false;
    if (k == 0 || system_.layout().m == 0) return true;
    adjoint.clear();
    adjoint.hold(replay.mode_before(k));
  }
  if (k > 0) adjoint.reverse_projection(replay.point(), replay.step());
  adjoint.reverse_matrices(replay.point());
  return true;
}

// Adds the parts of (18a) at both ends of the run, psi_y(0)^T y_rho(0) and w_rho, with one lane per
// parameter. The rates of the start are solved for again, since extend() goes on from there.
void AdjointGradient::add_boundaries(const VectorX<double>& adjoint, const State<double>* end,
                                     Eigen::VectorXd* gradient) {
  const IncrementLayout at(system_.layout());
  Equations<Lanes<8>>& equations = back_->boundary;
  back_->initial = integrator_.initial_state();
  integrator_.equations().hold({});
  if (!integrator_.assembly().rates().solve(&integrator_.equations(), &back_->initial).ok())
    gradient->setConstant(std::numeric_limits<double>::quiet_NaN());
  integrator_.equations().hold(integrator_.mode());
  const int count = static_cast<int>(gradient->size());
  for (int first = 0; first < count; first += 8) {
    const LaneRange<8> range{first, std::min(8, count - first)};
    std::vector<Lanes<8>>& seeded = back_->boundary_parameters;
    range.seed(system_, integrator_.equations().parameters(), &seeded);
    State<Lanes<8>>& state = back_->boundary_state;
    equations.set_design(seeded);
    integrator_.assembly().extend(seeded, integrator_.initial_state(), &equations,
                                  &back_->boundary_extension, &state);
    auto sum = gradient->segment(first, range.count);
    const auto add = [&](const VectorX<Lanes<8>>& part, int column) {
      for (Eigen::Index k = 0; k < part.size(); ++k)
        sum += adjoint[column + k] * part[k].directions().head(range.count);
    };
    add(state.q, at.x());
    add(state.s, at.s());
    add(state.v, at.v());
    add(state.z, at.z());
    if (end == nullptr) continue;
    cast_state(*end, &state);
    sum += equations.terminal(state).directions().head(range.count);
  }
}

bool AdjointGradient::go_back() {
  back_->adjoint.start(integrator_.equations().parameters(), back_->final_adjoint);
  back_->replay.begin(&integrator_);
  for (int k = back_->replay.size(); k-- > 0;) {
    if (is_set(cancel_)) return false;
    if (!step_back(k)) return false;
  }
  return true;
}

void AdjointGradient::add_derivatives(const State<double>& end, Eigen::VectorXd* gradient) {
  back_->adjoint.add_gradient(*gradient);
  back_->jumps.add_gradient(*gradient);
  add_boundaries(back_->adjoint.adjoint(), &end, gradient);
}

void AdjointGradient::differentiate_guard(int guard, Eigen::VectorXd* derivatives) {
  derivatives->setZero(to_signed(system_.study().tuned.size()));
  back_->final_adjoint.setZero();
  back_->jumps.start(integrator_.equations().parameters());
  back_->jumps.add_guard(guard, 1.0, integrator_.initial_state(), integrator_.mode(),
                         &back_->final_adjoint);
  back_->jumps.add_gradient(*derivatives);
  add_boundaries(back_->final_adjoint, nullptr, derivatives);
}

void AdjointGradient::look_beyond_end(const Eigen::VectorXd& gradient) {
  if (end_.moves()) return;
  const std::optional<EndCrossing> crossing = cross_end(&integrator_);
  if (!crossing) return;
  const ModeChange& change = crossing->change;
  Eigen::VectorXd behind = Eigen::VectorXd::Zero(gradient.size());
  take_terminal(change.behind);
  const bool goes_back =
      back_->jumps.reverse(run_jump(back_->replay.size() - 1, change), change.before, change.behind,
                           crossing->mode, 0.0, &back_->final_adjoint) &&
      go_back();
  if (goes_back) add_derivatives(change.behind, &behind);
  integrator_.equations().hold(crossing->mode);
  if (goes_back) one_sided_.compare(crossing->origin, gradient, behind, false);
}

void AdjointGradient::gradient(Eigen::VectorXd* gradient) {
  gradient->setZero(to_signed(system_.study().tuned.size()));
  if (!look_at_end()) return gradient->fill(std::numeric_limits<double>::quiet_NaN());
  prepare();
  if (!go_back()) return gradient->fill(std::numeric_limits<double>::quiet_NaN());
  add_derivatives(integrator_.state(), gradient);
  if (end_.moves()) *gradient += end_.objective_rate() * end_.time();
  look_beyond_end(*gradient);
}

}  // namespace codesign
