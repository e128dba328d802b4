// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/scalar.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(ValueOf, DropsTheFirstOrderPart) {
  EXPECT_EQ(value_of(-1.5), -1.5);
  EXPECT_EQ(value_of(std::complex<double>(-1.5, 7.0)), -1.5);
  EXPECT_EQ(value_of(Lanes<4>(-1.5, Lanes<4>::Vector{1.0, 2.0, 3.0, 4.0})), -1.5);
}

TEST(Scalar, MatricesOfLanesMultiplyAsTheChainRuleSays) {
  using L = Lanes<4>;
  Matrix3<L> A = Matrix3<L>::Identity();
  A(0, 1) = L(2.0, L::Vector{1.0, 0.0, 0.0, 0.0});
  const Vector3<L> y = A * Vector3<L>(L(1.0), L(3.0, L::Vector{0.0, 1.0, 0.0, 0.0}), L(5.0));
  EXPECT_EQ(y[0].a, 7.0);
  EXPECT_EQ(y[0].v[0], 3.0);
  EXPECT_EQ(y[0].v[1], 2.0);
}

}  // namespace
}  // namespace codesign
