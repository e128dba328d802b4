// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DESCRIPTION_REFERENCE_H_
#define MECHANISM_CODESIGN_DESCRIPTION_REFERENCE_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "description/quantity.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// What runs between way-points: a polynomial of the fifth, third or first degree.
enum class Interpolation { kQuintic, kCubic, kLinear };

/// offset + amplitude sin(2 pi f t + phase)
struct SineDescription {
  Quantity amplitude, phase, offset;  ///< phase [rad]
  Quantity frequency{1.0};            ///< f [Hz], or 1/f [s] if `is_period`
  bool is_period = false;
};

/// Points that a function of time goes through; theory (C2).
struct WaypointsDescription {
  Interpolation interpolation = Interpolation::kQuintic;
  std::vector<double> times;            ///< [s], ascending
  std::vector<Quantity> positions;      ///< one per time
  std::vector<Quantity> velocities;     ///< one per time, or none: chosen
  std::vector<Quantity> accelerations;  ///< likewise
};

/// A prescribed function of time: what a controller's setpoint or an objective's reference follows.
struct ReferenceDescription {
  enum class Kind { kConstant, kSine, kWaypoints };

  ReferenceDescription(Quantity value = 0.0) : constant(std::move(value)) {}  // NOLINT(google-explicit-constructor): a number is one
  ReferenceDescription(double value) : constant(value) {}                     // NOLINT(google-explicit-constructor)

  Kind kind = Kind::kConstant;
  Quantity constant;
  SineDescription sine;
  WaypointsDescription waypoints;
};

/// Where a trajectory_msgs/JointTrajectory lies.
struct TrajectoryAddress {
  std::string bag, topic, joint;
  SourceLocation where;  ///< in the study
  std::string element;   ///< in the study
};

/// The way-points of one joint of a recorded trajectory; velocities and accelerations may be missing.
struct RecordedTrajectory {
  std::vector<double> times, positions, velocities, accelerations;
};

/// Reads a recorded trajectory; given by who knows how, since the core knows no bags. @throws InputError if it cannot be read.
using TrajectoryLoader = std::function<RecordedTrajectory(const TrajectoryAddress&)>;

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DESCRIPTION_REFERENCE_H_
