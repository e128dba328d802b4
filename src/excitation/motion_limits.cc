// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/motion_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Kind = LimitedSignal::Kind;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr std::array<const char*, 4> kKindNames{"position", "velocity", "acceleration", "effort"};

/// Lower and upper limit of each kind.
struct Ranges {
  std::array<double, 4> lower{-kUnlimited, -kUnlimited, -kUnlimited, -kUnlimited};
  std::array<double, 4> upper{kUnlimited, kUnlimited, kUnlimited, kUnlimited};

  void narrow(Kind kind, double low, double high) {
    const auto k = to_index(kind);
    lower[k] = std::max(lower[k], low);
    upper[k] = std::min(upper[k], high);
  }
  void narrow(Kind kind, double magnitude) {
    narrow(kind, -std::abs(magnitude), std::abs(magnitude));
  }
};

Ranges ranges_of(const JointDescription& joint, const std::vector<double>& parameters,
                 const MotionLimitDescription* more) {
  Ranges ranges;
  if (has_stops(joint))
    ranges.narrow(Kind::kPosition, joint.limit->lower.at(parameters),
                  joint.limit->upper.at(parameters));
  if (joint.limit && joint.limit->bounds_velocity())
    ranges.narrow(Kind::kVelocity, joint.limit->velocity.at(parameters));
  if (joint.limit && joint.limit->bounds_effort())
    ranges.narrow(Kind::kEffort, joint.limit->effort.at(parameters));
  if (!more) return ranges;
  if (more->position) ranges.narrow(Kind::kPosition, (*more->position)[0], (*more->position)[1]);
  if (more->velocity) ranges.narrow(Kind::kVelocity, *more->velocity);
  if (more->acceleration) ranges.narrow(Kind::kAcceleration, *more->acceleration);
  if (more->effort) ranges.narrow(Kind::kEffort, *more->effort);
  return ranges;
}

void require_room(const JointDescription& joint, const Ranges& ranges, const SourceLocation& where,
                  const std::string& element) {
  if (ranges.lower[0] < ranges.upper[0]) return;
  throw InputError({where, element,
                    "no position is within the limits of the study and of " + joint.element(),
                    "[" + readable(ranges.lower[0]) + ", " + readable(ranges.upper[0]) + "]",
                    "lower below upper"});
}

/// @param index in `joints` or `followers`.
void add_signals(const JointDescription& joint, const Ranges& ranges, bool is_follower,
                 std::size_t index, MotionLimits* limits) {
  for (std::size_t k = 0; k < (is_follower ? 2U : 4U); ++k) {
    if (!std::isfinite(ranges.lower[k]) && !std::isfinite(ranges.upper[k])) continue;
    limits->signals.push_back({static_cast<Kind>(k), is_follower, to_signed(index), ranges.lower[k],
                               ranges.upper[k], joint.name + "/" + kKindNames[k]});
  }
}

void add_excited(const Problem& problem, const ExcitedJoint& excited, MotionLimits* limits) {
  const RobotDescription& robot = robot_of(problem);
  const JointDescription& joint = robot.joints[to_index(joint_named(robot, excited.limits.joint))];
  const Ranges ranges = ranges_of(joint, problem.parameters(), &excited.limits);
  require_room(joint, ranges, excited.limits.where, excited.limits.element);
  if (!std::isfinite(ranges.upper[to_index(Kind::kVelocity)]))
    throw InputError({excited.limits.where, excited.limits.element,
                      "the joint has no largest velocity, so that no motion is the best", "",
                      "velocity here, or in <limit> of " + joint.element()});
  add_signals(joint, ranges, false, limits->joints.size(), limits);
  limits->joints.push_back({joint.name, true, 1.0, excited.limits.where});
}

void add_follower(const Problem& problem, std::size_t index, MotionLimits* limits) {
  const JointDescription& joint = robot_of(problem).joints[index];
  if (joint.is_loop || !joint.has_one_coordinate()) return;
  const std::vector<MotionLimitDescription>& described = study_of(problem).excitation->followers;
  const auto more =
      std::find_if(described.begin(), described.end(),
                   [&](const MotionLimitDescription& one) { return one.joint == joint.name; });
  const bool is_described = more != described.end();
  for (const MeasuredJoint& excited : limits->joints)
    if (excited.name == joint.name) return;
  if (system_of(problem)->topology().joint_pair[index] < 0) {
    if (is_described)
      throw InputError(
          {more->where, more->element, "the joint moves no mass", joint.name, "joints that do"});
    return;
  }
  const Ranges ranges = ranges_of(joint, problem.parameters(), is_described ? &*more : nullptr);
  const std::size_t before = limits->signals.size();
  if (is_described) require_room(joint, ranges, more->where, more->element);
  add_signals(joint, ranges, true, limits->followers.size(), limits);
  if (limits->signals.size() > before)
    limits->followers.push_back({joint.name, false, 1.0, is_described ? more->where : joint.where});
}

}  // namespace

const LimitedSignal* MotionLimits::find(Eigen::Index joint, LimitedSignal::Kind kind) const {
  for (const LimitedSignal& signal : signals)
    if (!signal.is_follower && signal.joint == joint && signal.kind == kind) return &signal;
  return nullptr;
}

MotionLimits motion_limits(const Problem& problem) {
  MotionLimits limits;
  const std::vector<ExcitedJoint>& excited = study_of(problem).excitation->joints;
  limits.noise.resize(to_signed(excited.size()));
  for (std::size_t k = 0; k < excited.size(); ++k) {
    add_excited(problem, excited[k], &limits);
    limits.noise[to_signed(k)] = excited[k].noise;
  }
  for (std::size_t index = 0; index < robot_of(problem).joints.size(); ++index)
    add_follower(problem, index, &limits);
  return limits;
}

}  // namespace codesign
