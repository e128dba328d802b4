// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/course.h"

namespace codesign {
namespace {

struct CourseEnd {
  double time;
  Knot<double> knot;
  bool has_velocity, has_acceleration;
};

CourseEnd end_at(const CoursePoint& point) {
  return {point.time,
          {point.position, point.velocity.value_or(0.0), point.acceleration.value_or(0.0)},
          point.velocity.has_value(),
          point.velocity.has_value() && point.acceleration.has_value()};
}

Interpolation degree(const CourseEnd& from, const CourseEnd& to) {
  if (from.has_acceleration && to.has_acceleration) return Interpolation::kQuintic;
  return from.has_velocity && to.has_velocity ? Interpolation::kCubic : Interpolation::kLinear;
}

}  // namespace

Course held(double value, double start) {
  LiveFunction piece{true, start, {}};
  piece.c[0] = value;
  return {piece};
}

Course trajectory_course(const std::vector<CoursePoint>& points, double now,
                         const Knot<double>& from) {
  Course course;
  CourseEnd before{now, from, true, true};
  for (const CoursePoint& point : points) {
    const CourseEnd next = end_at(point);
    const double duration = next.time - before.time;
    if (next.time > now && duration > 0.0)
      course.push_back(
          {true, before.time,
           waypoint_polynomial(degree(before, next), before.knot, next.knot, duration)});
    before = next;
  }
  course.push_back(held(points.back().position, points.back().time).front());
  return course;
}

Course rate_of(Course course) {
  for (LiveFunction& piece : course) {
    for (std::size_t k = 0; k + 1 < piece.c.size(); ++k)
      piece.c[k] = static_cast<double>(k + 1) * piece.c[k + 1];
    piece.c.back() = 0.0;
  }
  return course;
}

}  // namespace codesign
