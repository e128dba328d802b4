// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "control/course.h"

namespace codesign {
namespace {

/// A course as a function: the last piece that has begun.
ReferenceMotion<double> at(const Course& course, double t) {
  auto function = std::make_shared<LiveFunction>();
  for (const LiveFunction& piece : course)
    if (piece.start <= t) *function = piece;
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kLive;
  description.live = {function, std::make_shared<const ReferenceDescription>(-7.0)};
  return Reference<double>(description, {}).at(t);
}

TEST(TrajectoryCourse, AHeldValueBeginsWhereItBegins) {
  const Course course = held(0.4, 2.0);
  EXPECT_EQ(at(course, 1.9).value, -7.0) << "the planned function";
  EXPECT_EQ(at(course, 2.0).value, 0.4);
  EXPECT_EQ(at(course, 9.0).rate, 0.0);
}

TEST(TrajectoryCourse, IsLinearWithoutVelocities) {
  const Course course =
      trajectory_course({{1.0, 2.0, {}, {}}, {3.0, 6.0, {}, {}}}, 0.0, {0.0, 5.0, 0.0});
  EXPECT_EQ(at(course, 0.0).value, 0.0);
  EXPECT_EQ(at(course, 0.5).value, 1.0);
  EXPECT_EQ(at(course, 0.5).rate, 2.0);
  EXPECT_EQ(at(course, 2.0).value, 4.0);
  EXPECT_EQ(at(course, 3.0).value, 6.0);
  EXPECT_EQ(at(course, 3.0).rate, 0.0);
}

TEST(TrajectoryCourse, IsCubicBetweenVelocitiesAndBeginsWithTheMotionInEffect) {
  const Course course =
      trajectory_course({{1.0, 1.0, 0.0, {}}, {2.0, 0.0, -1.0, {}}}, 0.0, {0.0, 3.0, 8.0});
  EXPECT_EQ(at(course, 0.0).rate, 3.0);
  // 3 t - 3 t^2 + t^3 meets (1, slope 0); t^2 (-2 + t) from (1, 0) meets (0, -1).
  EXPECT_NEAR(at(course, 0.5).value, 1.5 - 0.75 + 0.125, 1e-15);
  EXPECT_NEAR(at(course, 1.0).rate, 0.0, 1e-15);
  EXPECT_NEAR(at(course, 1.5).value, 1.0 - 2.0 * 0.25 + 0.125, 1e-15);
  EXPECT_EQ(at(course, 2.5).value, 0.0);
}

TEST(TrajectoryCourse, IsOfFifthDegreeBetweenAccelerations) {
  const Course course = trajectory_course({{0.0, 0.0, 0.0, 0.0}, {2.0, 4.0, 0.0, 0.0}}, 0.0, {});
  EXPECT_NEAR(at(course, 1.0).value, 2.0, 1e-14);
  EXPECT_NEAR(at(course, 1.0).rate, 1.875 * 2.0, 1e-14);
  EXPECT_NEAR(at(course, 1.0).acceleration, 0.0, 1e-13);
}

TEST(TrajectoryCourse, WhatIsPastIsLeftOutAndTheRestStaysWhereItWas) {
  const std::vector<CoursePoint> points{{0.0, 0.0, {}, {}}, {1.0, 1.0, {}, {}}, {2.0, 3.0, {}, {}}};
  const Course late = trajectory_course(points, 1.5, {-9.0, 0.0, 0.0});
  ASSERT_EQ(late.size(), 2U);
  EXPECT_EQ(at(late, 1.5).value, 2.0);
  EXPECT_EQ(at(late, 2.5).value, 3.0);
  const Course over = trajectory_course(points, 5.0, {});
  ASSERT_EQ(over.size(), 1U);
  EXPECT_EQ(at(over, 5.0).value, 3.0);
}

TEST(TrajectoryCourse, TheRateOfACourseIsItsDerivative) {
  const Course course = trajectory_course({{0.0, 1.0, 2.0, -1.0}, {1.5, 4.0, 0.5, 3.0}}, 0.0, {});
  const Course rate = rate_of(course);
  for (double t : {0.0, 0.4, 1.1, 2.0}) {
    EXPECT_NEAR(at(rate, t).value, at(course, t).rate, 1e-12);
    EXPECT_NEAR(at(rate, t).rate, at(course, t).acceleration, 1e-12);
  }
}

}  // namespace
}  // namespace codesign
