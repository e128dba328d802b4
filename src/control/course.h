// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "control/reference.h"

namespace codesign {

/// A point of a commanded trajectory.
struct CoursePoint {
  double time = 0.0, position = 0.0;  ///< [s] of the run, [rad or m]
  std::optional<double> velocity, acceleration;
};

/// The pieces of a commanded function of time, by ascending start: each is in effect until the next
/// one begins, the last one has no end.
using Course = std::vector<LiveFunction>;

/// A course that holds a value from `start` [s] on.
Course held(double value, double start);

/// The course through points, theory (C2): of fifth degree between points with accelerations, cubic
/// between points with velocities, else linear. After the last point its position holds.
/// @param points by ascending time, at least one. @param now [s]: pieces that end before it are
/// left out. @param from the motion in effect at `now`, from which the first piece begins if all
/// points are later.
Course trajectory_course(const std::vector<CoursePoint>& points, double now,
                         const Knot<double>& from);

/// The rate of a course, as a course.
Course rate_of(Course course);

}  // namespace codesign
