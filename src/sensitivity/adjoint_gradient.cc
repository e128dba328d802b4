// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_gradient.h"

#include <algorithm>
#include <limits>

#include "math/arrays.h"
#include "text/cancel.h"

namespace codesign {

AdjointGradient::Backward::Backward(const CompiledSystem& system, const RosenbrockTableau& tableau,
                                    int most_points)
    : replay(system, tableau),
      adjoint(system, tableau),
      boundary(system),
      path(system.layout(), most_points) {
  point.resize(system.layout());
  final_adjoint.setZero(IncrementLayout(system.layout()).size());
}

AdjointGradient::AdjointGradient(const CompiledSystem& system, int most_points)
    : system_(system), most_points_(most_points), integrator_(system), end_(system) {
  judge_ = [this](RosenbrockStep<double>* step) { return control_->attempt(step); };
}

// The workspace of the backward pass is allocated only when a gradient is requested.
Status AdjointGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  with_gradient_ = derivatives != Derivatives::kNone;
  integrator_.watch_singularities(with_gradient_);
  Status status = integrator_.start(parameters);
  if (!status.ok() || !with_gradient_) return status;
  if (!back_) {
    back_.emplace(system_, integrator_.step().tableau(), most_points_);
    back_->replay.keep_pivots_of(integrator_.step());
    control_ = make_control_tangent(system_);
  }
  control_->start(parameters, &integrator_);
  back_->path.clear();
  back_->path.append(0.0, integrator_.step().tableau(), integrator_.initial_state());
  return status;
}

Status AdjointGradient::advance(double limit) {
  if (!with_gradient_) return integrator_.advance(limit);
  Status status = integrator_.advance(limit, judge_);
  const RosenbrockStep<double>& step = integrator_.step();
  if (!status.ok()) return status;
  control_->accept(step);
  back_->path.append(step.step_size(), step.tableau(), step.unprojected());
  return status;
}

double AdjointGradient::objective() {
  return integrator_.of_squares(integrator_.psi(),
                                integrator_.equations().terminal(integrator_.state()));
}

// The backward pass begins with the gradient of the terminal terms as the adjoint of the last
// state, and 1 for psi.
void AdjointGradient::prepare() {
  const std::vector<double>& parameters = integrator_.equations().parameters();
  const IncrementLayout at(system_.layout());
  VectorX<double>& adjoint = back_->final_adjoint;
  integrator_.equations().terminal_gradient(integrator_.state(), &back_->terminal);
  adjoint.setZero();
  adjoint[at.psi()] = 1.0;
  for (const auto& e : back_->terminal.position) adjoint[at.x() + e.column] += e.value;
  for (const auto& e : back_->terminal.velocity) adjoint[at.v() + e.column] += e.value;
  for (const auto& e : back_->terminal.rate) adjoint[at.z() + e.column] += e.value;
  back_->adjoint.start(parameters, adjoint);
  back_->replay.equations().set_design(parameters);
  back_->replay.use(back_->path.tableau(0));
  back_->replay.start(integrator_.initial_state());
  back_->replay.choose_pivots(back_->path.size() > 1 ? back_->path.step_size(1)
                                                     : integrator_.step().step_size());
}

/// Continues the solution at point k, which `point` holds.
bool AdjointGradient::take_up(int k) {
  RosenbrockStep<double>& step = back_->replay;
  if (k + 1 < back_->path.size()) step.use(back_->path.tableau(k + 1));
  if (k == 0) {
    step.start(back_->point);
  } else if (!step.resume(back_->point)) {
    return false;
  }
  // Turn counts follow the nearest previous positions, in the backward pass as well.
  step.track_turns();
  return true;
}

/// Sets `point` to the k-th point of the path. If it was not stored, the steps from the last stored
/// point before it are repeated.
bool AdjointGradient::reach(int k) {
  StepPath& path = back_->path;
  State<double>& point = back_->point;
  RosenbrockStep<double>& step = back_->replay;
  const int from = path.kept_before(k);
  path.point(from, &point);
  if (from == k) return true;
  const int spacing = path.make_room(from, k);
  for (int at = from; at < k; ++at) {
    if (is_set(cancel_)) return false;
    if (!take_up(at) || !step.attempt(path.step_size(at + 1))) return false;
    point = step.unprojected();
    if (at + 1 == k || (at + 1 - from) % spacing == 0) path.keep(at + 1, point);
  }
  return true;
}

/// Repeats the step that began at point k; at the last point, only the projection.
bool AdjointGradient::replay(int k) {
  if (!take_up(k)) return false;
  return k + 1 == back_->path.size() || back_->replay.attempt(back_->path.step_size(k + 1));
}

bool AdjointGradient::step_back(int k) {
  AdjointStep& adjoint = back_->adjoint;
  if (!reach(k) || !replay(k)) return false;
  RosenbrockStep<double>& step = back_->replay;
  const bool has_stages = k + 1 < back_->path.size(), is_projected = k > 0;
  adjoint.clear();
  if (has_stages) adjoint.reverse_stages(&step);
  if (is_projected) adjoint.reverse_projection(back_->point, step);
  adjoint.reverse_matrices(back_->point);
  return true;
}

// Adds the parts of (18a) at both ends of the run, psi_y(0)^T y_rho(0) and w_rho, with one lane per
// parameter.
void AdjointGradient::add_boundaries(Eigen::VectorXd* gradient) {
  const IncrementLayout at(system_.layout());
  const VectorX<double>& adjoint = back_->adjoint.adjoint();
  Equations<Lanes<8>>& equations = back_->boundary;
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
    cast_state(integrator_.state(), &state);
    sum += equations.terminal(state).directions().head(range.count);
  }
}

bool AdjointGradient::go_back() {
  prepare();
  for (int k = back_->path.size(); k-- > 0;) {
    if (is_set(cancel_)) return false;
    if (!step_back(k)) return false;
  }
  return true;
}

void AdjointGradient::gradient(Eigen::VectorXd* gradient) {
  gradient->setZero(to_signed(system_.study().tuned.size()));
  if (!go_back()) {
    gradient->setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  back_->adjoint.add_gradient(*gradient);
  add_boundaries(gradient);
  if (!has_moving_end(system_.study()) || !integrator_.has_ended()) return;
  const Status status = end_.evaluate(
      &integrator_, duration_gradient(system_.study(), integrator_.equations().parameters()));
  *gradient += (status.ok() ? end_.objective_rate() : std::numeric_limits<double>::quiet_NaN()) *
               end_.time();
}

}  // namespace codesign
