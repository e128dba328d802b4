// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/shaped_input.h"

#include <gtest/gtest.h>

#include "math/differences.h"

namespace codesign {
namespace {

const std::vector<double> kCoefficients{1.0, -2.0, 0.5, 3.0, 4.0};

BasisDescription basis(BasisShape shape) {
  BasisDescription b;
  b.shape = shape;
  b.duration = 2.0;
  b.coefficients.assign(kCoefficients.begin(), kCoefficients.end());
  return b;
}

TEST(ShapedInput, LinearRunsThroughItsCoefficientsAndHoldsTheLast) {
  const BasisDescription b = basis(BasisShape::kLinear);
  const ShapedInput<double> input(b, {});
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(input.at(0.5 * k).value, kCoefficients[static_cast<std::size_t>(k)], 1e-15);
  EXPECT_NEAR(input.at(0.25).rate, -6.0, 1e-14);
  EXPECT_EQ(input.at(7.0).value, 4.0);
  EXPECT_EQ(input.at(7.0).rate, 0.0);
}

TEST(ShapedInput, CubicHasTheRateOfItsValues) {
  const BasisDescription b = basis(BasisShape::kCubic);
  const ShapedInput<double> input(b, {});
  EXPECT_NEAR(input.at(0.0).value, 1.0, 1e-15);
  for (double t : {0.3, 0.9, 1.7}) {
    const double rate =
        ridders_derivative([&](double s) { return input.at(s).value; }, t, 0.05).value;
    EXPECT_NEAR(input.at(t).rate, rate, 1e-9);
  }
}

TEST(ShapedInput, DerivativesByCoefficientsAreTheWeights) {
  BasisDescription b = basis(BasisShape::kCubic);
  b.coefficients[2] =
      Quantity(kCoefficients[2], std::make_shared<Expression>("c", std::vector<std::string>{"c"}));
  Lanes<4> c(kCoefficients[2]);
  c.v[1] = 1.0;
  const ShapedInput<Lanes<4>> input(b, {c});
  const BasisWeights weights = basis_weights(b, 0.9);
  EXPECT_NEAR(input.at(0.9).value.v[1], weights.value[static_cast<std::size_t>(2 - weights.first)],
              1e-15);
}

}  // namespace
}  // namespace codesign
