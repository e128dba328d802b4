// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace codesign {

/// Times start + k step, k = 0 ... count - 1.
struct UniformTimes {
  double start = 0.0, step = 0.0;  ///< [s]
  Eigen::Index count = 0;
  bool exact = false;  ///< whether no interpolation is needed: no sample is missing, and all lie within 1e-3 steps of the uniform times

  double rate() const { return 1.0 / step; }
  double at(Eigen::Index k) const { return start + static_cast<double>(k) * step; }
};

/// Equal steps through the times of a recording: from the first to the last, one step per period. A pause counts as the nearest whole
/// number of median periods. @param times ascending, at least two
UniformTimes uniform_times(const std::vector<double>& times);

/// How values between samples are interpolated; doc/theory.md (30).
enum class Between {
  kLinear,  ///< for efforts, which may jump: a cubic would overshoot at a jump
  kCubic    ///< for smooth motion, by cubics with slopes of the parabola through three neighbours: linear pieces would have no acceleration
};

/// Values at the uniform times. @param times ascending, at least three. @param values one per time
Eigen::VectorXd resample(const std::vector<double>& times, const std::vector<double>& values, const UniformTimes& uniform, Between between);

/// The derivative of equally spaced samples [unit/s]; doc/theory.md (31). By central differences of eighth order, at the four samples next
/// to the ends of order six, four and two, and at the ends themselves by one-sided differences of order two.
/// @param samples at least three. @param step [s]
Eigen::VectorXd derivative(const Eigen::VectorXd& samples, double step);

/// The integral of equally spaced samples [unit s], zero at the first; doc/theory.md (49). Each step integrates the polynomial of degree
/// five through six neighbours, the two steps next to the ends the polynomial of degree three through four, so that integral() is the
/// inverse of derivative() up to the bandwidth of the filter. @param samples at least four. @param step [s]
Eigen::VectorXd integral(const Eigen::VectorXd& samples, double step);

}  // namespace codesign
