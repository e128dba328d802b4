// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/quantity.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// The k-th of two independent variables.
Lanes<4> lane(double value, int k) {
  Lanes<4> x(value);
  x.v[k] = 1.0;
  return x;
}

TEST(Quantity, ConstantIsTheSameEverywhere) {
  const Quantity constant = 3.0;
  EXPECT_TRUE(constant.is_constant());
  EXPECT_EQ(constant.at(std::vector<double>{7.0}), 3.0);
  EXPECT_EQ(constant.at(std::vector<std::complex<double>>{{7.0, 1.0}}), std::complex<double>(3.0));
  const Lanes<4> lanes = constant.at(std::vector<Lanes<4>>{lane(7.0, 0)});
  EXPECT_EQ(lanes.a, 3.0);
  EXPECT_EQ(lanes.v[0], 0.0);
  EXPECT_EQ(lanes.v[1], 0.0);
}

TEST(Quantity, OnlyTheConstantZeroIsZero) {
  EXPECT_TRUE(Quantity().is_zero());
  EXPECT_TRUE(Quantity(-0.0).is_zero());
  EXPECT_FALSE(Quantity(1e-300).is_zero());
  EXPECT_FALSE(Quantity(0.0, std::make_shared<const Expression>("x", std::vector<std::string>{"x"}))
                   .is_zero());
}

TEST(Quantity, LanesCarryTheChainRule) {
  const Quantity product(
      6.0, std::make_shared<const Expression>("x*y", std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(product.nominal(), 6.0);
  std::vector<Lanes<4>> at = {lane(2.0, 0), lane(5.0, 1)};
  at[0].v = 10.0 * at[0].v;  // the parameter itself has a derivative
  const Lanes<4> value = product.at(at);
  EXPECT_DOUBLE_EQ(value.a, 10.0);
  EXPECT_DOUBLE_EQ(value.v[0], 50.0);
  EXPECT_DOUBLE_EQ(value.v[1], 2.0);
}

TEST(Quantity, ComplexStepGoesThrough) {
  const Quantity square(4.0,
                        std::make_shared<const Expression>("x**2", std::vector<std::string>{"x"}));
  const std::complex<double> value = square.at(std::vector<std::complex<double>>{{3.0, 1e-20}});
  EXPECT_DOUBLE_EQ(value.real(), 9.0);
  EXPECT_DOUBLE_EQ(value.imag(), 6e-20);
}

}  // namespace
}  // namespace codesign
