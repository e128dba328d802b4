// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/integration/motion_watch.h"

#include <algorithm>
#include <cmath>

#include "mechanism_codesign/math/decimal.h"

namespace codesign {
namespace {

constexpr double kBeyondReason = 10.0;  // times the typical speed
constexpr std::int64_t kWindow = 500;   // steps that tell the present pace
constexpr double kPatience = 0.1;       // of maximum_steps
constexpr double kLeastPatience = 5000.0;

bool is_velocity(const Signal& signal) {
  return std::any_of(signal.begin(), signal.end(), [](const SignalReference& term) {
    return term.kind == SignalKind::kJointVelocity || term.kind == SignalKind::kLinkVelocity ||
           term.kind == SignalKind::kLinkAngularVelocity || term.kind == SignalKind::kJointSlidingVelocity;
  });
}

}  // namespace

MotionWatch::Speeds MotionWatch::speeds(const State<double>& state) const {
  Speeds fastest;
  for (int b = 0; b < system_.layout().bodies; ++b) {
    const double linear = state.v.segment<3>(kBodySize * b).norm();
    // |omega| = 2 |p'|: p' stands at right angles to the unit vector p.
    const double angular = 2.0 * state.v.segment<4>(kBodySize * b + 3).norm();
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

// Angles and lengths are not told apart: a target speed excuses both kinds.
double MotionWatch::target(const Equations<double>& equations) const {
  const Study& study = system_.study();
  double largest = 0.0;
  for (std::size_t c = 0; c < system_.controllers().size(); ++c)
    if (is_velocity(system_.controllers()[c].input)) largest = std::max(largest, std::abs(equations.setpoint(static_cast<int>(c))));
  const auto look = [&](const std::vector<ResolvedTerm>& terms, const std::vector<ObjectiveTerm>& descriptions) {
    for (const ResolvedTerm& term : terms) {
      const Quantity& reference = descriptions[static_cast<std::size_t>(term.description)].reference;
      if (is_velocity(term.signal)) largest = std::max(largest, std::abs(reference.at(equations.parameters())));
    }
  };
  look(system_.integral(), study.integral);
  look(system_.terminal(), study.terminal);
  return largest;
}

void MotionWatch::start(const Equations<double>& equations, const State<double>& initial) {
  mark_time_ = initial.t;
  mark_work_ = 0;
  linear_bound_ = angular_bound_ = system_.study().solver.maximum_speed;
  if (linear_bound_ > 0.0) return;
  double size = 0.0;
  for (int b = 0; b < system_.layout().bodies; ++b) size = std::max(size, initial.q.segment<3>(kBodySize * b).norm());
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
  if (options.maximum_speed > 0.0) return exceeded(state, "as solver.maximum_speed says");
  if (work - mark_work_ < kWindow) return {};
  const double expected = expected_work(state.t, work);
  mark_time_ = state.t;
  mark_work_ = work;
  if (expected <= std::max(kLeastPatience, kPatience * options.maximum_steps)) return {};
  return exceeded(state, "the study would take some " + std::to_string(std::llround(expected)) +
                             " steps. Check signs and bounds of the gains, or give solver.maximum_speed if such speeds are meant");
}

}  // namespace codesign
