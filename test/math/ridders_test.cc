// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/ridders.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Ridders, IsExactForAPolynomialOfLowDegree) {
  // d/dx (x^5 - 2 x^2) at 1.5: 5 * 5.0625 - 6.
  const RiddersDerivative d = ridders_derivative([](double x) { return std::pow(x, 5) - 2.0 * x * x; }, 1.5, 0.5);
  EXPECT_NEAR(d.value, 19.3125, 1e-11);
  EXPECT_LT(d.error, 1e-9);
}

TEST(Ridders, ExtrapolationBeatsACentralDifferenceOfTheSameSteps) {
  const double step = 0.2, exact = std::exp(0.3);
  const RiddersDerivative d = ridders_derivative([](double x) { return std::exp(x); }, 0.3, step);
  const double smallest = step / 32.0, difference = (std::exp(0.3 + smallest) - std::exp(0.3 - smallest)) / (2.0 * smallest);
  EXPECT_LT(std::abs(d.value - exact), 1e-12);
  EXPECT_GT(std::abs(difference - exact), 1e-6);
}

TEST(Ridders, TheEstimateCoversTheErrorOfALongStep) {
  const double t = std::tanh(0.6), exact = 30.0 * (1.0 - t * t);
  const RiddersDerivative d = ridders_derivative([](double x) { return std::tanh(30.0 * x); }, 0.02, 0.1);
  EXPECT_GT(d.error, 1e-8);
  EXPECT_LT(std::abs(d.value - exact), d.error);
}

TEST(Ridders, CallsTwicePerLevel) {
  int calls = 0;
  ridders_derivative([&calls](double x) { return ++calls, x; }, 0.0, 1.0);
  EXPECT_EQ(calls, 12);
}

}  // namespace
}  // namespace codesign
