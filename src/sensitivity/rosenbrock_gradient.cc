// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/rosenbrock_gradient.h"

#include <algorithm>
#include <limits>

#include "math/arrays.h"
#include "sensitivity/motion_rates.h"

namespace codesign {
namespace {

/// Number of lanes that fit into memory: a multiple of eight, at least four.
int lanes_in_memory(const CompiledSystem& system) {
  constexpr int kMemory = 128000000,
                kPerNumber = 375;  // [bytes]; kPerNumber measured on chains of 1000 and 3000 links
  const int lanes = kMemory / (kPerNumber * IncrementLayout(system.layout()).size());
  return std::max(4, lanes / 8 * 8);
}

}  // namespace

RosenbrockGradient::RosenbrockGradient(const CompiledSystem& system, int most_lanes)
    : system_(system),
      integrator_(system),
      most_lanes_(most_lanes > 0 ? most_lanes : lanes_in_memory(system)),
      watch_(system),
      residuals_(system),
      end_(system),
      one_sided_(system),
      is_identity_(control_directions(system).isIdentity()) {
  const double tolerance = sensitivity_tolerance(system.study().solver);
  stages_ = [this, tolerance](OneStep<double>* step) {
    double error = control_ ? control_->attempt(step) : 0.0;
    if (error > 1.0) return error;
    groups_->for_each([&](auto* group) {
      group->step.attempt(step);
      if (!control_) error = std::max(error, group->step.error(*step, tolerance));
    });
    return error;
  };
}

bool RosenbrockGradient::judges_parameters() const {
  return most_lanes() >= count() && is_identity_;
}

// The workspace of the tangents is allocated only when derivatives are requested.
Status RosenbrockGradient::start(const std::vector<double>& parameters, Derivatives derivatives) {
  with_gradient_ = derivatives != Derivatives::kNone;
  with_root_ = derivatives == Derivatives::kGaussNewton;
  end_.start();
  one_sided_.start();
  integrator_.watch_singularities(with_gradient_);
  Status status = integrator_.start(parameters);
  if (with_gradient_ && judges_parameters())
    control_.reset();
  else if (with_gradient_ && !control_)
    control_ = make_control_tangent(system_);
  if (status.ok() && with_gradient_) {
    carry(0, parameters);
    one_sided_.look_at_start(&integrator_, [this](int guard, Eigen::VectorXd* by) {
      guard_time(guard, -1.0, integrator_.initial_state(), by);
    });
  }
  return status.ok() ? start_watches() : status;
}

Status RosenbrockGradient::start_watches() {
  if (with_root_) {
    const auto rows = [this](ObjectivePart part, const State<double>& state, Eigen::MatrixXd* to) {
      differentiate_residuals(part, state, to);
    };
    if (Status status = residuals_.start(&integrator_, rows); !status.ok()) return status;
  }
  if (watch_.is_empty()) return {};
  SignalWatch::Differentiate derivatives;
  if (with_gradient_)
    derivatives = [this](std::size_t k, const State<double>& state, bool reads_rates,
                         Eigen::VectorXd* gradient) {
      differentiate(k, state, reads_rates, gradient);
    };
  return watch_.start(&integrator_, std::move(derivatives));
}

void RosenbrockGradient::differentiate_residuals(ObjectivePart part, const State<double>& state,
                                                 Eigen::MatrixXd* rows) {
  const bool at_end = part == ObjectivePart::kTerminal;
  const auto terms = to_signed((at_end ? system_.terminal() : system_.integral()).size());
  rows->resize(count(), terms);
  groups_->for_each([&](auto* group) {
    auto* const own = at_end ? &group->terminal_residuals : &group->integral_residuals;
    if (at_end)
      group->step.terminal_residuals(state, own);
    else
      group->step.integral_residuals(integrator_.step(), state, own);
    rows->middleRows(group->range.first, group->range.count) = own->topRows(group->range.count);
  });
}

void RosenbrockGradient::differentiate(std::size_t watched, const State<double>& state,
                                       bool reads_rates, Eigen::VectorXd* gradient) {
  gradient->resize(count());
  groups_->for_each([&](auto* group) {
    const auto all = group->step.watched(watched, integrator_.step(), state, reads_rates,
                                         integrator_.assembly());
    gradient->segment(group->range.first, group->range.count) = all.head(group->range.count);
  });
  if (end_.moves() && state.t >= time())
    *gradient += end_.watched_rate(watched, &integrator_.equations()) * end_.time();
}

void RosenbrockGradient::carry(int first, const std::vector<double>& parameters) {
  const int lanes = std::min(most_lanes(), count() - first);
  if (first != first_ || lanes != lanes_) {
    groups_.reset();
    groups_.emplace(LaneCount{lanes, 0, first}, system_, integrator_.step().tableau());
    first_ = first;
    lanes_ = lanes;
  }
  groups_->for_each([&](auto* group) {
    group->step.keep_previous(with_root_ || !watch_.is_empty());
    group->range.seed(system_, parameters, &group->parameters);
    group->step.start(group->parameters, integrator_.assembly(), integrator_.initial_state(),
                      integrator_.mode());
  });
  if (control_) control_->start(parameters, &integrator_);
}

Status RosenbrockGradient::jump() {
  Status status = integrator_.jump();
  if (!status.ok() || !integrator_.has_jumped() || !with_gradient_) return status;
  if (integrator_.is_ended()) look_at_jump();
  groups_->for_each([this](auto* group) { group->step.jump(&integrator_); });
  if (control_) control_->jump(&integrator_);
  return status;
}

// A jump may make the condition true that ends the run. Its instant moves with its guard.
void RosenbrockGradient::look_at_jump() {
  const ModeChange& change = integrator_.mode_change();
  if (change.guard >= 0)
    guard_time(change.guard, change.guard_rate, change.end, &time_of_jump_);
  else
    time_of_jump_.setZero(count());
}

void RosenbrockGradient::guard_time(int guard, double rate, const State<double>& end,
                                    Eigen::VectorXd* time) {
  time->setZero(count());
  groups_->for_each([&](auto* group) {
    time->segment(group->range.first, group->range.count) =
        group->step.guard_time(guard, rate, end).head(group->range.count);
  });
}

// Extreme values there move along. The end of a run has its own derivatives.
Status RosenbrockGradient::look_at_switch() {
  switch_ = {};
  switch_time_.resize(0);
  if (watch_.is_empty() || integrator_.has_ended() || integrator_.guard() < 0) return {};
  motion_ = integrator_.state();
  if (Status status = solve_motion(&integrator_, &motion_, &motion_rates_); !status.ok())
    return status;
  const double rate = integrator_.guard_rate(motion_, motion_rates_);
  if (rate == 0.0) return {};
  switch_ = {integrator_.guard(), rate};
  guard_time(switch_.guard, rate, integrator_.state(), &switch_time_);
  return {};
}

Status RosenbrockGradient::look_at_end() {
  if (!has_moving_end(system_.study()) || !integrator_.has_ended()) return {};
  Eigen::VectorXd time = time_of_jump_;
  if (!integrator_.is_ended())
    time = duration_gradient(system_.study(), integrator_.equations().parameters());
  if (Status status = end_.evaluate(&integrator_, time); !status.ok()) return status;
  const int guard = integrator_.end_guard();
  if (guard < 0) return {};
  const double rate = integrator_.guard_rate(end_.state(), end_.rates());
  if (Status status = integrator_.judge_end(rate); !status.ok()) return status;
  guard_time(guard, rate, integrator_.state(), &time);
  end_.set_guard(guard, rate, time);
  return {};
}

void RosenbrockGradient::accept() {
  groups_->for_each([this](auto* group) { group->step.accept(integrator_.step()); });
  if (control_) control_->accept(integrator_.step());
}

Status RosenbrockGradient::advance(double limit) {
  const double before = time();
  if (with_gradient_)
    if (Status status = jump(); !status.ok()) return status;
  Status status = with_gradient_ ? integrator_.advance(limit, stages_) : integrator_.advance(limit);
  if (!status.ok()) return status;
  // A jump at the beginning of the step may have ended the run.
  const bool has_stepped = time() > before;
  if (with_gradient_ && has_stepped) accept();
  if (with_gradient_) status = look_at_end();
  if (with_gradient_ && status.ok()) status = look_at_switch();
  if (status.ok() && with_root_) residuals_.look();
  if (status.ok() && !watch_.is_empty())
    status = has_stepped ? watch_.look(switch_time_) : watch_.end();
  return status;
}

double RosenbrockGradient::objective() {
  return integrator_.of_losses(integrator_.psi(),
                               integrator_.equations().terminal(integrator_.state()));
}

void RosenbrockGradient::gradient(Eigen::VectorXd* gradient) {
  gradient->setConstant(count(), std::numeric_limits<double>::quiet_NaN());
  collect(integrator_.state(), gradient);
  if (most_lanes() >= count()) return look_beyond_end(*gradient);
  const double end = time();
  const std::vector<double> parameters = integrator_.equations().parameters();
  for (int first = most_lanes(); first < count(); first += most_lanes()) {
    if (!integrator_.start(parameters).ok()) return;
    carry(first, parameters);
    while (time() < end)
      if (!advance(integrator_.end()).ok()) return;
    collect(integrator_.state(), gradient);
  }
}

// The gradient of runs that end behind a guard which is zero at the end of this one.
void RosenbrockGradient::look_beyond_end(const Eigen::VectorXd& gradient) {
  const std::optional<EndCrossing> crossing = cross_end(&integrator_);
  if (!crossing) return;
  const ModeChange& change = crossing->change;
  const bool has_jumped = change.guard >= 0;
  Eigen::VectorXd behind = gradient, time = Eigen::VectorXd::Zero(count());
  if (has_jumped) guard_time(change.guard, change.guard_rate, change.end, &time);
  groups_->for_each([&](auto* group) {
    const auto kept = group->step.directions();
    if (has_jumped) group->step.cross(change);
    group->step.jump({}, integrator_.state(), change.behind, integrator_.assembly(), change.mode);
    collect(group, change.behind, &behind);
    group->step.go_back(kept, crossing->mode);
  });
  integrator_.equations().hold(crossing->mode);
  one_sided_.compare(crossing->origin, gradient, behind, !watch_.is_empty() && !time.isZero(0.0));
}

void RosenbrockGradient::collect(const State<double>& end, Eigen::VectorXd* gradient) {
  groups_->for_each([&](auto* group) { collect(group, end, gradient); });
}

template <int N>
void RosenbrockGradient::collect(Group<N>* group, const State<double>& end,
                                 Eigen::VectorXd* gradient) const {
  const auto total = (group->step.psi() + group->step.terminal(end)).eval();
  auto part = gradient->segment(group->range.first, group->range.count);
  part = total.head(group->range.count);
  if (end_.moves())
    part += end_.objective_rate() * end_.time().segment(group->range.first, group->range.count);
}

}  // namespace codesign
