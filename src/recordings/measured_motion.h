// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "description/identification.h"
#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Times start + k step, k = 0 ... count - 1.
struct UniformTimes {
  double start = 0.0, step = 0.0;  ///< [s]
  Eigen::Index count = 0;
  /// whether no interpolation is needed: no sample is missing, and all lie within 1e-3 steps of the
  /// uniform times
  bool exact = false;

  double rate() const { return 1.0 / step; }
  double at(Eigen::Index k) const { return start + static_cast<double>(k) * step; }
};

/// Equal steps through the times of a recording: from the first to the last, one step per period. A
/// pause counts as the nearest whole number of median periods. @param times ascending, at least two
UniformTimes uniform_times(const std::vector<double>& times);

/// How values between samples are interpolated; doc/theory.md (30).
enum class Resampling {
  kLinear,  ///< for efforts, which may jump: a cubic would overshoot at a jump
  /// for smooth motion, by cubics with slopes of the parabola through three neighbours: linear
  /// pieces would have no acceleration
  kCubic
};

/// Values at the uniform times. @param times ascending, at least three. @param values one per time
Eigen::VectorXd resample(const std::vector<double>& times, const std::vector<double>& values,
                         const UniformTimes& uniform, Resampling between);

/// The derivative of equally spaced samples [unit/s]; doc/theory.md (31). By central differences of
/// eighth order, at the four samples next to the ends of order six, four and two, and at the ends
/// themselves by one-sided differences of order two.
/// @param samples at least three. @param step [s]
Eigen::VectorXd derivative(const Eigen::VectorXd& samples, double step);

/// The integral of equally spaced samples [unit s], zero at the first; doc/theory.md (49). Each
/// step integrates the polynomial of degree five through six neighbours, the two steps next to the
/// ends the polynomial of degree three through four, so that integral() is the inverse of
/// derivative() up to the bandwidth of the filter. @param samples at least four. @param step [s]
Eigen::VectorXd integral(const Eigen::VectorXd& samples, double step);

/// The motion of a joint at equal steps, and its recorded effort; in the joint's units.
struct JointMotion {
  std::string joint;
  /// empty if the recording does not determine them
  Eigen::VectorXd position, velocity, acceleration;
  Eigen::VectorXd effort;          ///< as recorded, not filtered; empty if not recorded
  bool velocity_measured = false;  ///< false: the velocity is the derivative of the position
  /// false: the position is the integral of the velocity from JointSamples::start
  bool position_measured = true;
  double least_speed = 0.0;  ///< JointSamples::least_speed
  bool has_bounds = false;   ///< JointSamples::has_bounds
};

/// A recording at equal steps, with velocities and accelerations; doc/theory.md (29)-(31).
struct MeasuredMotion {
  std::string element;   ///< the entry of the study: `identify.data[0]`
  SourceLocation where;  ///< place of this entry, for messages
  UniformTimes times;
  std::vector<JointMotion> joints;  ///< in the order of the recording
  /// of JointRecording::signals, not filtered, in their units
  std::vector<Eigen::VectorXd> signals;
  /// The samples to fit: `first`, `first + every`, ... below `end`. Near the ends a filter has
  /// samples on one side only, so that 2/cutoff is left out at each end, for both cutoffs; the
  /// effect of the mirrored end on a filter of order four has then decayed to 1 %.
  Eigen::Index first = 0, end = 0, every = 1;

  Eigen::Index fitted() const { return end > first ? (end - first + every - 1) / every : 0; }
};

/// Number of samples of a recording that a filter leaves to fit, MeasuredMotion::fitted(); 0 if it
/// is too short for the filter.
Eigen::Index samples_to_fit(const JointRecording& recording, const FilterOptions& filter);

/// Positions and measured velocities are resampled by cubics, efforts by lines; positions and
/// velocities are filtered at `cutoff`; a velocity that was not measured is the derivative of the
/// position, and the acceleration is always the derivative of the velocity. A position that was not
/// measured is the integral of the filtered velocity from the joint's start in the study; without a
/// start it is empty.
///
/// For residuals in effort the caller must filter both measured and computed efforts at
/// `residual_cutoff`, and then take them at the samples to fit.
/// @param recording as load_recordings() returns it. Warns with `recording_resampled`,
/// `recording_not_filtered` and `recording_aliased`.
/// @throws InputError if a cutoff is not below half of the rate, or the recording is too short for
/// the filter.
MeasuredMotion measured_motion(const JointRecording& recording, const FilterOptions& filter,
                               Warnings* warnings);

}  // namespace codesign
