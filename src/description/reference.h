// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "description/live_function.h"
#include "description/quantity.h"
#include "math/sampled_function.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// The polynomials between way-points: of fifth, third or first degree; kMonotone: of fifth degree, between the values of each two
/// neighbours; theory (C2).
enum class Interpolation { kQuintic, kCubic, kLinear, kMonotone };

/// offset + amplitude sin(2 pi f t + phase); theory (C1).
struct SineDescription {
  Quantity amplitude, phase, offset;  ///< phase [rad]; the others in the unit of the signal
  Quantity frequency{1.0};            ///< f [Hz], or 1/f [s] if `is_period`
  bool is_period = false;
};

/// Way-points that a function of time passes through; theory (C2).
struct WaypointsDescription {
  Interpolation interpolation = Interpolation::kQuintic;
  std::vector<double> times;            ///< [s], ascending
  std::vector<Quantity> positions;      ///< one per time
  std::vector<Quantity> velocities;     ///< one per time, or empty: chosen as theory (C2) says
  std::vector<Quantity> accelerations;  ///< likewise
};

/// scale f(t + delay) - offset, with f through samples; theory (C2a).
struct SampledDescription {
  std::shared_ptr<const SampledFunction> samples;  ///< f
  Quantity scale{1.0}, delay, offset;              ///< delay [s]
};

struct ReferenceDescription;

/// A function that commands set during a run, and the planned function until the first command; both not null.
struct LiveDescription {
  std::shared_ptr<const LiveFunction> function;
  std::shared_ptr<const ReferenceDescription> planned;
};

/// A prescribed function of time: the setpoint of a controller or the reference of an objective's term. Of the alternatives the one
/// that `kind` names is used.
struct ReferenceDescription {
  enum class Kind { kConstant, kSine, kWaypoints, kSampled, kLive };

  ReferenceDescription(Quantity value = 0.0)
      : constant(std::move(value)) {}                      // NOLINT(google-explicit-constructor): a number is a constant reference
  ReferenceDescription(double value) : constant(value) {}  // NOLINT(google-explicit-constructor)

  Kind kind = Kind::kConstant;
  Quantity constant;
  SineDescription sine;
  WaypointsDescription waypoints;
  SampledDescription sampled;  ///< of recorded efforts; studies do not name it
  LiveDescription live;        ///< of commands (CommandInputs); studies do not name it
};

/// The address of a joint's trajectory in a trajectory_msgs/JointTrajectory message of a bag.
struct TrajectoryAddress {
  std::string bag, topic, joint;
  SourceLocation where;  ///< the place in the study that names it, for messages
  std::string element;   ///< likewise
};

/// The way-points of one joint of a recorded trajectory: times [s], then one value per time in the joint's units. Velocities and
/// accelerations may be empty.
struct RecordedTrajectory {
  std::vector<double> times, positions, velocities, accelerations;
};

/// Callback that reads a recorded trajectory. The caller provides it, since this library does not depend on ROS, which reads bags.
/// @throws InputError if the trajectory cannot be read.
using TrajectoryLoader = std::function<RecordedTrajectory(const TrajectoryAddress&)>;

}  // namespace codesign
