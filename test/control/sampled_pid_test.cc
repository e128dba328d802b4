// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <complex>

#include "control/sampled_pid.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

TEST(Clamp, CutsBeyondItsBoundsAlone) {
  EXPECT_EQ(clamp(0.5, 2.0), 0.5);
  EXPECT_EQ(clamp(3.0, 2.0), 2.0);
  EXPECT_EQ(clamp(-3.0, 2.0), -2.0);
  EXPECT_EQ(clamp(0.0, 0.0), 0.0);
}

TEST(Clamp, HasTheDerivativeOfTheInsideOnTheBound) {
  const Complex x(2.0, kStep), bound(2.0, 3.0 * kStep);
  EXPECT_EQ(clamp(x, bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(-2.0, kStep), bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(2.1, kStep), bound).imag(), 3.0 * kStep);
  EXPECT_EQ(clamp(Complex(-2.1, kStep), bound).imag(), -3.0 * kStep);
}

TEST(ClampedIntegral, StopsAtTheBoundAndLeavesItAtOnce) {
  // i = 4, bound 2: the bound is s = 0.5, and errors of 0.005 are small.
  constexpr double kSmall = 1e-5;
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, 4.0, 2.0), 0.0, kSmall);
  EXPECT_LE(clamped_integral_rate(3.0, 0.5, 4.0, 2.0), 0.0) << "never beyond the bound";
  EXPECT_LE(clamped_integral_rate(0.001, 0.5, 4.0, 2.0), 0.0);
  EXPECT_NEAR(clamped_integral_rate(-3.0, 0.5, 4.0, 2.0), -3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(-3.0, -0.5, 4.0, 2.0), 0.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, -0.5, 4.0, 2.0), 3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.25, 4.0, 2.0), 3.0 * (1.0 - 1.0 / 256.0), kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, -4.0, 2.0), 0.0, kSmall)
      << "the sign of the gain does not matter";
  EXPECT_NEAR(clamped_integral_rate(0.0, 0.5, 4.0, 2.0), -0.0025, 1e-15)
      << "half of the small error, inwards";
  EXPECT_EQ(clamped_integral_rate(3.0, 0.0, 4.0, 2.0), 3.0);
  EXPECT_EQ(clamped_integral_rate(3.0, 7.0, 0.0, 2.0), 3.0) << "without a gain nothing is bounded";
}

/// Pid::computeCommand() of control_toolbox 1.19 (ROS 1), written down from its documentation and
/// behaviour: gains, symmetric bounds.
struct ToolboxPid {
  double p, i, d, i_max;
  bool antiwindup;
  double i_error = 0.0, last = 0.0;
  bool valid = false;

  double command(double error, double dt) {
    const double rate = valid ? (error - last) / dt : 0.0;
    last = error;
    valid = true;
    i_error += dt * error;
    if (antiwindup && i != 0.0)
      i_error = std::clamp(i_error, -i_max / std::abs(i), i_max / std::abs(i));
    const double integral = antiwindup ? i * i_error : std::clamp(i * i_error, -i_max, i_max);
    return p * error + integral + d * rate;
  }
};

constexpr double kErrors[] = {1.0, 0.8, 1.5, 2.0, 1.1, -0.4, -2.0, -3.0, -1.0, 0.2, 0.0, 0.7};

TEST(SampledPid, DoesWhatControlToolboxDoes) {
  for (const bool antiwindup : {false, true})
    for (const double i : {6.0, -6.0, 0.0}) {
      ToolboxPid toolbox{2.0, i, 0.05, 0.9, antiwindup};
      const double clamp = 0.9;
      const SampledPidNumbers<double> numbers{{2.0, i, 0.05}, 0.1, 0.0, &clamp, antiwindup};
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
  const SampledPidNumbers<double> numbers{{0.0, 0.0, 1.0}, 0.1, 0.3, nullptr, false};
  SampledPidMemory<double> memory;
  EXPECT_EQ(sample_pid(numbers, 5.0, 5.0, true, &memory), 0.0) << "no kick at the start";
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 6.0, 6.0, false, &memory), 2.5);
  EXPECT_DOUBLE_EQ(sample_pid(numbers, 6.0, 6.0, false, &memory), 1.875);
}

// The set-point steps by 1 while the input rests at 2: the rate of the input is zero.
TEST(SampledPid, TheRateOfTheInputDoesNotSeeTheSetPoint) {
  const SampledPidNumbers<double> numbers{{3.0, 0.0, 1.0}, 0.1, 0.0, nullptr, false};
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
  const C bound(0.2, kTiny);
  const SampledPidNumbers<C> numbers{{C(2.0), C(4.0), C(0.0)}, 0.1, C(0.0), &bound, true};
  SampledPidMemory<C> memory;
  EXPECT_EQ(sample_pid(numbers, C(1.0), C(1.0), true, &memory).imag(), kTiny);
  EXPECT_EQ(memory.integral.imag(), 0.25 * kTiny);
}

}  // namespace

}  // namespace codesign
