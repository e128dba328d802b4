// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A slide that coasts takes a few long steps, in which signals and guards turn round many times.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A slide of 2 kg that begins at 0.1 m with the speed `speed`, over 200 m; `force` in N and `size`
/// are parameters, too.
Evaluation of_slide(double speed, const std::string& more, double way = 200.0) {
  const std::string study =
      "duration: " + to_decimal(way / speed) +
      "\ngravity: [0, 0, 0]\ninitial_state: {slide: {position: 0.1, velocity: \"${speed}\"}}\n"
      "parameters: {speed: {initial: " +
      to_decimal(speed) + "}, force: {initial: 3.0}, size: {initial: 0.7}}\n" + more;
  const Problem problem =
      load_problem({"slide.urdf", robot(mass("piston", 2.0) + lift("slide", "piston", 0.0))}, {},
                   {"study.yaml", study});
  return Evaluator(problem).evaluate(problem.start(), true);
}

class Coasting : public ::testing::TestWithParam<double> {};

// sin(x) > c in 32 humps of the width 2 acos(c) [m].
TEST_P(Coasting, ADwellCountsEveryStay) {
  const double speed = GetParam(), c = 0.975, stay = 32.0 * 2.0 * std::acos(c) / speed;
  const Evaluation found = of_slide(
      speed, "objective: {dwell: [{signal: \"${sin(slide/position)}\", band: [0.975, 2]}]}\n");
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(found.objective, stay, 1e-9 * stay);
  EXPECT_NEAR(found.gradient[0], -stay / speed, 1e-8 * stay / speed);
}

// The highest of many humps, at x = 137 m.
TEST_P(Coasting, AMaximumIsTheHighestOfAllHumps) {
  const Evaluation found =
      of_slide(GetParam(),
               "objective: {maximum: [{signal: \"${size*cos(slide/position - 137)/(1 + "
               "((slide/position - 137)/10)^2)}\"}]}\n");
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(found.objective, 0.7, 1e-10);
  EXPECT_NEAR(found.gradient[2], 1.0, 1e-9);
  EXPECT_NEAR(found.gradient[0], 0.0, 1e-8);
}

// An integrand that is 1 where cos(x) > c, from 2 pi k - acos(c) on.
TEST_P(Coasting, AnIntegralSeesEveryPulse) {
  const double speed = GetParam(), c = 0.9, a = std::acos(c), width = (a - 0.1) + 31.0 * 2.0 * a,
               time = width / speed;
  const Evaluation found = of_slide(
      speed, "objective: {integral: [{signal: \"${cos(slide/position) > 0.9 ? 1 : 0}\"}]}\n");
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(found.objective, time, 1e-9 * time);
  EXPECT_NEAR(found.gradient[0], -time / speed, 1e-8 * time / speed);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Coasting, ::testing::Values(0.5, 10.0, 300.0));

// A force in windows of the position: m v^2/2 grows by force times their lengths.
TEST(CoastingSlide, AForceActsInEveryWindow) {
  // cos(6 x) > 0.9: from 0.1 m on half a window is passed but for 0.1 m, then one whole.
  const double half = std::acos(0.9) / 6.0, length = 2.0 * half;
  const Evaluation found =
      of_slide(1.0,
               "loads: [{joint: slide, effort: \"${cos(6*slide/position) > 0.9 ? force : 0}\"}]\n"
               "objective: {terminal: [{signal: slide/velocity}]}\n",
               1.5);
  const double v = std::sqrt(1.0 + 3.0 * length);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(found.objective, v * v, 1e-8);
  EXPECT_NEAR(found.gradient[1], length, 1e-7);
  EXPECT_NEAR(found.gradient[0], 2.0, 1e-7);
  ASSERT_EQ(found.events.count, 2);
}

// A window that lasts a thousandth of the run, written as a square.
TEST(CoastingSlide, AShortWindowIsSeen) {
  const Evaluation found = of_slide(
      1.0,
      "loads: [{joint: slide, effort: \"${(slide/position - size)^2 < 1.0e-6 ? 100*force : 0}\"}]\n"
      "objective: {terminal: [{signal: slide/velocity}]}\n",
      2.0);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  EXPECT_NEAR(found.objective, 1.0 + 300.0 * 2e-3, 1e-8);
  EXPECT_NEAR(found.gradient[1], 100.0 * 2e-3, 1e-7);
}

}  // namespace
}  // namespace codesign
