// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/directions.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Directions, ImaginaryPartsAreOneColumn) {
  VectorX<std::complex<double>> x(2);
  x << std::complex<double>(1.0, 2.0), std::complex<double>(3.0, -4.0);
  EXPECT_EQ(directions_of(x), Eigen::Vector2d(2.0, -4.0));
  add_directions(Eigen::MatrixXd(Eigen::Vector2d(0.5, 1.0)), &x);
  EXPECT_EQ(x[0], std::complex<double>(1.0, 2.5));
  EXPECT_EQ(x[1], std::complex<double>(3.0, -3.0));
}

TEST(Directions, EachLaneIsAColumn) {
  using L = Lanes<4>;
  VectorX<L> x(2);
  x << L(1.0, L::Vector{1.0, 2.0, 3.0, 4.0}), L(2.0, L::Vector{5.0, 6.0, 7.0, 8.0});
  Eigen::MatrixXd expected(2, 4);
  expected << 1, 2, 3, 4, 5, 6, 7, 8;
  EXPECT_EQ(directions_of(x), expected);
  add_directions(Eigen::MatrixXd(-expected), &x);
  EXPECT_EQ(directions_of(x), Eigen::MatrixXd::Zero(2, 4));
  EXPECT_EQ(x[1].a, 2.0) << "the value stays";
}

}  // namespace
}  // namespace codesign
