// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <complex>

#include "control/sampled_pid.h"

namespace codesign {
namespace {

/// Pid::computeCommand() of control_toolbox 1.19 (ROS 1), written down from its documentation and
/// behaviour: gains, bounds, anti-windup.
struct ToolboxPid {
  double p, i, d, i_min, i_max;
  bool antiwindup;
  double i_error = 0.0, last = 0.0;
  bool valid = false;

  double command(double error, double dt) {
    const double rate = valid ? (error - last) / dt : 0.0;
    last = error;
    valid = true;
    i_error += dt * error;
    if (antiwindup && i != 0.0)
      i_error = std::clamp(i_error, std::min(i_min / i, i_max / i), std::max(i_min / i, i_max / i));
    const double integral = antiwindup ? i * i_error : std::clamp(i * i_error, i_min, i_max);
    return p * error + integral + d * rate;
  }
};

constexpr double kErrors[] = {1.0, 0.8, 1.5, 2.0, 1.1, -0.4, -2.0, -3.0, -1.0, 0.2, 0.0, 0.7};

TEST(SampledPid, DoesWhatControlToolboxDoes) {
  for (const Bounds<double>& clamp :
       {Bounds<double>{-0.9, 0.9, true}, Bounds<double>{-0.3, 0.9, false},
        Bounds<double>{0.0, 1.2, false}})
    for (const bool antiwindup : {false, true})
      for (const double i : {6.0, -6.0, 0.0}) {
        ToolboxPid toolbox{2.0, i, 0.05, clamp.lower, clamp.upper, antiwindup};
        const SampledPidNumbers<double> numbers{
            {2.0, i, 0.05},
            0.1,
            0.0,
            &clamp,
            antiwindup ? AntiWindup::kClamping : AntiWindup::kNone};
        SampledPidMemory<double> memory;
        bool is_first = true;
        for (const double e : kErrors) {
          EXPECT_NEAR(sample_pid(numbers, e, e, is_first, &memory), toolbox.command(e, 0.1), 1e-14);
          EXPECT_NEAR(memory.integral, toolbox.i_error, 1e-15);
          is_first = false;
        }
      }
}

TEST(SampledPid, FiltersTheRateByTheBackwardDifference) {
  // tau y' + y = e' with T = 0.1, tau = 0.3: y_1 = (0.3 * 0 + 1) / 0.4 for a step of 1, then it
  // falls by 3/4 per sample.
  const SampledPidNumbers<double> numbers{{0.0, 0.0, 1.0}, 0.1, 0.3};
  SampledPidMemory<double> memory;
  EXPECT_EQ(sample_pid(numbers, 5.0, 5.0, true, &memory), 0.0) << "no kick at the start";
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 6.0, 6.0, false, &memory), 2.5);
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 6.0, 6.0, false, &memory), 1.875);
}

// The set-point steps by 1 while the input rests at 2: the rate of the input is zero.
TEST(SampledPid, TheRateOfTheInputDoesNotSeeTheSetPoint) {
  const SampledPidNumbers<double> numbers{{3.0, 0.0, 1.0}, 0.1, 0.0};
  SampledPidMemory<double> of_error, of_input;
  EXPECT_EQ(sample_pid(numbers, -2.0, -2.0, true, &of_error), -6.0);
  EXPECT_EQ(sample_pid(numbers, -2.0, -2.0, true, &of_input), -6.0);
  EXPECT_DOUBLE_EQ(sample_pid(numbers, -1.0, -1.0, false, &of_error), -3.0 + 1.0 / 0.1);
  EXPECT_DOUBLE_EQ(sample_pid(numbers, -1.0, -2.0, false, &of_input), -3.0);
}

TEST(SampledPid, IsDifferentiableByGainsAndBounds) {
  using C = std::complex<double>;
  constexpr double kTiny = 1e-30;
  // With anti-windup and a clamp that is reached the integral is bound / i, so that it and its term
  // follow the bound.
  const Bounds<C> bound{C(-0.2, -kTiny), C(0.2, kTiny), true};
  const SampledPidNumbers<C> numbers{
      {C(2.0), C(4.0), C(0.0)}, 0.1, C(0.0), &bound, AntiWindup::kClamping};
  SampledPidMemory<C> memory;
  EXPECT_EQ(sample_pid(numbers, C(1.0), C(1.0), true, &memory).imag(), kTiny);
  EXPECT_EQ(memory.integral.imag(), 0.25 * kTiny);
}

// By hand, p = 1, i = 2, T = 0.1, limit 3: at e = 4 the integral is 0.4, v = 4.8, which is 1.8
// beyond.
TEST(SampledPid, WhatTheLimitCutsOffDrawsTheIntegralBack) {
  const Bounds<double> limit{-3.0, 3.0, true};
  // T_t i = 0.5: 0.1 * 1.8 / 0.5 is taken off.
  const SampledPidNumbers<double> numbers{
      {1.0, 2.0, 0.0}, 0.1, 0.0, nullptr, AntiWindup::kBackCalculation, &limit, 0.5};
  SampledPidMemory<double> memory;
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 4.0, 4.0, true, &memory), 4.8) << "before the limit";
  EXPECT_DOUBLE_EQ(memory.integral, 0.4 - 0.36);
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 1.0, 1.0, false, &memory), 1.0 + 2.0 * 0.14);
  EXPECT_DOUBLE_EQ(memory.integral, 0.14) << "within the limit nothing is taken off";
}

TEST(SampledPid, ConditionalIntegrationStopsAtTheLimit) {
  const Bounds<double> limit{-1.0, 3.0, false};
  for (const double i : {2.0, -2.0}) {
    const SampledPidNumbers<double> numbers{{i / 2.0, i, 0.0},        0.1,   0.0, nullptr,
                                            AntiWindup::kConditional, &limit};
    const double to_upper = i > 0.0 ? 1.0 : -1.0;
    SampledPidMemory<double> memory;
    EXPECT_DOUBLE_EQ(sample_pid(numbers, 4.0 * to_upper, 0.0, true, &memory), 4.0);
    EXPECT_DOUBLE_EQ(memory.integral, 0.0) << "the proportional term alone is beyond";
    EXPECT_DOUBLE_EQ(sample_pid(numbers, 2.8 * to_upper, 0.0, false, &memory), 3.0);
    EXPECT_NEAR(memory.integral, 0.1 * to_upper, 1e-15) << "as far as the limit allows";
    EXPECT_NEAR(sample_pid(numbers, -0.9 * to_upper, 0.0, false, &memory), -0.9 + 0.2 - 0.18,
                1e-15);
    EXPECT_NEAR(memory.integral, 0.01 * to_upper, 1e-15) << "the error leads back";
  }
}

}  // namespace

}  // namespace codesign
