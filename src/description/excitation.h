// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "description/control_realization.h"
#include "description/expression.h"
#include "mechanism_codesign/error.h"

namespace codesign {

// The block `excite:` of a study: the motion that an identification is to be recorded from;
// doc/study.md describes the keys.

/// The kind of shapes of a trajectory; doc/theory.md (45).
enum class TrajectoryKind {
  kFourier,  ///< a Fourier series
  kSpline    ///< cubic B-splines
};
constexpr std::array<const char*, 2> kTrajectoryNames{"fourier", "spline"};

/// The method of the search; NLopt's names.
enum class TrajectorySearchMethod { kSlsqp, kCcsaq, kMma };
constexpr std::array<const char*, 3> kTrajectorySearchNames{"slsqp", "ccsaq", "mma"};

/// Limits of one joint that the study gives, in addition to `<limit>`: the narrower limits count.
struct MotionLimitDescription {
  std::string joint;
  std::optional<std::array<double, 2>> position;         ///< lower and upper [rad or m]
  std::optional<double> velocity, acceleration, effort;  ///< largest magnitudes, positive
  std::string element;                                   ///< `excite.joints.shoulder`
  SourceLocation where;
};

/// A joint that is moved.
struct ExcitedJoint {
  MotionLimitDescription limits;
  double noise = 0.0;  ///< standard deviation of one sample of its effort, positive [N m or N]
};

/// The whole block.
struct ExcitationDescription {
  /// as many as there are degrees of freedom, independent of each other
  std::vector<ExcitedJoint> joints;
  std::vector<MotionLimitDescription> followers;  ///< limits of other joints
  TrajectoryKind trajectory = TrajectoryKind::kFourier;
  double period = 10.0;        ///< [s]
  int harmonics = 5;           ///< of kFourier
  int knots = 20;              ///< of kSpline: intervals between knots in a period
  int periods = 1;             ///< that are recorded, one after the other
  double sample_rate = 100.0;  ///< of the recording and of the way-points [Hz]
  int starts = 4;              ///< searches, the first from the plain trajectory
  std::uint32_t seed = 1;
  TrajectorySearchMethod search = TrajectorySearchMethod::kSlsqp;
  int max_evaluations = 1000;  ///< of one search
  SourceLocation where;
};

/// Where the robot keeps the gains of one controller of the study: an entry of `hardware:`.
/// doc/study.md describes it and the parameters that control_toolbox::Pid reads there.
struct HardwareGains {
  std::string controller;  ///< a `pid` or `pd_gravity` of the study
  /// of ROS parameters, without a slash at either end: "arm_controller/gains/elbow"
  std::string name_space;
  /// bounds of the effort of the integral term [N m or N]; present if the controller has an `i`
  /// gain
  std::optional<ControlBounds> i_clamp;
  bool antiwindup = false;  ///< whether the integral of the error itself stays within i_clamp / i
  SourceLocation where;
};

}  // namespace codesign
