// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/motion_watch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "control/reference.h"
#include "text/decimal.h"

namespace codesign {
namespace {

constexpr double kBeyondReason = 10.0;     // speeds beyond this multiple of the typical one are suspicious
constexpr std::int64_t kWindow = 500;      // steps over which the pace is measured
constexpr double kPatience = 0.1;          // expected steps, relative to maximum_steps, from which a suspicious run ends
constexpr double kLeastPatience = 5000.0;  // [steps] lower limit of the same

constexpr int kInstants = 64;  // instants at which setpoints and references are sampled

constexpr SignalKind kVelocities[] = {SignalKind::kJointVelocity, SignalKind::kJointSlidingVelocity, SignalKind::kLinkVelocity,
                                      SignalKind::kLinkAngularVelocity};
constexpr SignalKind kPositions[] = {SignalKind::kJointPosition, SignalKind::kLinkPosition};

template <std::size_t N>
bool reads(const Signal& signal, const SignalKind (&kinds)[N]) {
  return std::any_of(signal.begin(), signal.end(), [&kinds](const SignalReference& term) {
    return std::find(std::begin(kinds), std::end(kinds), term.kind) != std::end(kinds);
  });
}

bool is_commanded(const ReferenceDescription& description) {
  return description.kind == ReferenceDescription::Kind::kLive && description.live.function->commanded;
}

/// The largest speed that commands ask for at this time. With an effort that is commanded every speed can be meant.
double commanded_speed(const CompiledSystem& system, double t) {
  double largest = 0.0;
  for (std::size_t c = 0; c < system.controllers().size(); ++c) {
    const ControllerDescription& controller = system.study().controllers[c];
    if (is_commanded(controller.feedforward) && controller.feedforward.live.function->c[0] != 0.0)
      return std::numeric_limits<double>::infinity();
    if (!is_commanded(controller.setpoint)) continue;
    const ReferenceMotion<double> asked = Reference<double>::commanded_at(*controller.setpoint.live.function, t);
    if (reads(system.controllers()[c].input, kVelocities)) largest = std::max(largest, std::abs(asked.value));
    if (reads(system.controllers()[c].input, kPositions)) largest = std::max(largest, std::abs(asked.rate));
  }
  return largest;
}

}  // namespace

MotionWatch::Speeds MotionWatch::speeds(const State<double>& state) const {
  Speeds fastest;
  motion_.move(state.q, state.v);
  for (int b = 0; b < system_.layout().bodies; ++b) {
    const auto [linear, angular] = motion_.speed(b, state.v);
    if (linear > fastest.linear) {
      fastest.linear = linear;
      fastest.linear_body = b;
    }
    if (angular > fastest.angular) {
      fastest.angular = angular;
      fastest.angular_body = b;
    }
  }
  return fastest;
}

// The largest speed that setpoints and references ask for. Angles and lengths are not distinguished: it counts for both kinds of speed.
double MotionWatch::target(const Equations<double>& equations) const {
  const Study& study = system_.study();
  double largest = 0.0;
  const auto look = [&](const Signal& signal, const Reference<double>& reference) {
    const bool velocity = reads(signal, kVelocities), position = reads(signal, kPositions);
    for (int k = 0; (velocity || position) && k <= kInstants; ++k) {
      const ReferenceMotion<double> asked = reference.at(study.duration * k / kInstants);
      largest = std::max(largest, std::abs(velocity ? asked.value : asked.rate));
    }
  };
  const Design<double>& design = equations.formulas().view().design;
  for (std::size_t c = 0; c < study.controllers.size(); ++c) look(system_.controllers()[c].input, design.controllers[c].setpoint);
  for (const ResolvedTerm& term : system_.integral())
    look(term.signal, design.integral.references[static_cast<std::size_t>(term.description)]);
  for (const ResolvedTerm& term : system_.terminal())
    look(term.signal, design.terminal.references[static_cast<std::size_t>(term.description)]);
  return largest;
}

void MotionWatch::start(const Equations<double>& equations, const State<double>& initial) {
  mark_time_ = initial.t;
  mark_work_ = 0;
  motion_.set_design(equations);
  linear_bound_ = angular_bound_ = system_.study().solver.maximum_speed;
  // A mechanism without controllers cannot gain energy, so it needs no automatic limit.
  if (linear_bound_ > 0.0 || system_.study().controllers.empty()) return;
  double size = 0.0;
  motion_.move(initial.q, initial.v);
  for (int b = 0; b < system_.layout().bodies; ++b) size = std::max(size, motion_.distance(b, initial.q));
  const double g = Eigen::Vector3d(system_.study().gravity.data()).norm(), aim = target(equations);
  const Speeds begun = speeds(initial);
  linear_bound_ = kBeyondReason * std::max({begun.linear, aim, std::sqrt(2.0 * g * size)});
  angular_bound_ = kBeyondReason * std::max({begun.angular, aim, size > 0.0 ? std::sqrt(2.0 * g / size) : 0.0});
}

double MotionWatch::expected_work(double time, std::int64_t work) const {
  const double rest = std::max(0.0, system_.study().duration - time), pace = static_cast<double>(work - mark_work_) / (time - mark_time_);
  return static_cast<double>(work) + rest * pace;
}

Status MotionWatch::exceeded(const State<double>& state, const std::string& advice) const {
  const Speeds now = speeds(state);
  const auto sentence = [&](int body, const char* verb, double speed, const char* unit, double bound) {
    return "the motion runs away: link '" + system_.topology().bodies[static_cast<std::size_t>(body)].name + "' " + verb + " at " +
           std::to_string(std::llround(speed)) + " " + unit + ", beyond " + to_decimal(bound) + "; " + advice;
  };
  if (angular_bound_ > 0.0 && now.angular > angular_bound_)
    return {StatusCode::kUnstableMotion, state.t, sentence(now.angular_body, "turns", now.angular, "rad/s", angular_bound_)};
  if (linear_bound_ > 0.0 && now.linear > linear_bound_)
    return {StatusCode::kUnstableMotion, state.t, sentence(now.linear_body, "moves", now.linear, "m/s", linear_bound_)};
  return {};
}

Status MotionWatch::check(const State<double>& state, std::int64_t work) {
  const SolverOptions& options = system_.study().solver;
  if (options.maximum_speed > 0.0) return exceeded(state, "the limit is solver.maximum_speed");
  if (work - mark_work_ < kWindow) return {};
  const double expected = expected_work(state.t, work);
  mark_time_ = state.t;
  mark_work_ = work;
  if (expected <= std::max(kLeastPatience, kPatience * options.maximum_steps)) return {};
  const double commanded = kBeyondReason * commanded_speed(system_, state.t);
  linear_bound_ = std::max(linear_bound_, commanded);
  angular_bound_ = std::max(angular_bound_, commanded);
  return exceeded(state, "the study would take some " + std::to_string(std::llround(expected)) +
                             " steps. Check signs and bounds of the gains, or set solver.maximum_speed if such speeds are intended");
}

}  // namespace codesign
