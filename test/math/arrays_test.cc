// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "math/arrays.h"

namespace codesign {
namespace {

double sum(In<double> x) {
  double sum = 0.0;
  for (double one : x) sum += one;
  return sum;
}

void set(double value, Out<double> x) {
  for (double& one : x) one = value;
}

TEST(Span, IsMadeOfWhatLiesSideBySide) {
  const std::vector<double> numbers{1.0, 2.0, 3.0};
  const double plain[] = {1.0, 2.0};
  const Eigen::Matrix<double, 2, Eigen::Dynamic> lanes = Eigen::Matrix<double, 2, 3>::Ones();
  EXPECT_EQ(sum(numbers), 6.0);
  EXPECT_EQ(sum(plain), 3.0);
  EXPECT_EQ(sum(std::array<double, 2>{3.0, 4.0}), 7.0);
  EXPECT_EQ(sum(LineVector(3, 2.0)), 6.0);
  EXPECT_EQ(sum(Eigen::Vector3d(1.0, 2.0, 4.0)), 7.0);
  EXPECT_EQ(sum(Eigen::Map<const Eigen::VectorXd>(numbers.data(), 2)), 3.0);
  EXPECT_EQ(sum(lanes), 6.0);
  EXPECT_EQ(sum(lanes.col(1)), 2.0);
  EXPECT_EQ(sum({}), 0.0);
  EXPECT_TRUE(In<double>().empty());
}

TEST(Span, OutOfAnArrayChangesIt) {
  std::vector<double> numbers(3, 0.0);
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(2);
  double plain[2] = {};
  set(1.0, numbers);
  set(2.0, vector);
  set(3.0, plain);
  EXPECT_EQ(numbers[2], 1.0);
  EXPECT_EQ(vector[1], 2.0);
  EXPECT_EQ(plain[1], 3.0);
  const Out<double> out = numbers;
  EXPECT_EQ(sum(out), 3.0);
  EXPECT_EQ(In<double>(out).data(), numbers.data());
}

TEST(Span, GapsConstantsAndTemporariesAreRefused) {
  using Matrix = Eigen::Matrix4d;
  EXPECT_FALSE((std::is_convertible_v<Matrix::RowXpr&, In<double>>));
  EXPECT_FALSE((std::is_convertible_v<Matrix::BlockXpr&, In<double>>));
  EXPECT_TRUE((std::is_convertible_v<Matrix::ColXpr&, Out<double>>));
  EXPECT_FALSE((std::is_convertible_v<const std::vector<double>&, Out<double>>));
  EXPECT_FALSE((std::is_convertible_v<const Eigen::VectorXd&, Out<double>>));
  EXPECT_FALSE((std::is_convertible_v<In<double>, Out<double>>));
  EXPECT_FALSE((std::is_convertible_v<std::vector<double>, Out<double>>));
  EXPECT_FALSE((std::is_convertible_v<std::vector<int>&, In<double>>));
}

TEST(Span, PartsCountFromTheirOwnBeginning) {
  std::vector<double> numbers{1.0, 2.0, 3.0, 4.0};
  const Out<double> all = numbers, middle = all.subspan(1, 2);
  EXPECT_EQ(middle.size(), 2);
  EXPECT_EQ(middle[1], 3.0);
  middle[0] = 7.0;
  EXPECT_EQ(numbers[1], 7.0);
  EXPECT_EQ(sum(all.first(2)), 8.0);
  EXPECT_TRUE(all.subspan(4, 0).empty());
}

TEST(SpanDeathTest, WhatIsOutsideEndsADebugBuild) {
#ifdef NDEBUG
  GTEST_SKIP() << "only debug builds check";
#else
  const double numbers[] = {1.0, 2.0};
  const In<double> span = numbers;
  EXPECT_DEATH(static_cast<void>(span[2]), "k < size_");
  EXPECT_DEATH(static_cast<void>(span[-1]), "k < size_");
  EXPECT_DEATH(static_cast<void>(span.first(3)), "count <= size_");
  EXPECT_DEATH(static_cast<void>(span.subspan(1, 2)), "count <= size_");
#endif
}

TEST(LineVector, BeginsWithACacheLineWhateverItsSize) {
  for (std::size_t size : {1U, 7U, 100U, 10001U}) {
    const LineVector x(size, 2.0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(x.data()) % 64, 0U);
    EXPECT_EQ(x.back(), 2.0);
  }
}

TEST(LineVector, CopiesAndMovesAsOthersDo) {
  LineVector x(3, 1.0);
  LineVector y = x;
  y[0] = 5.0;
  EXPECT_EQ(x[0], 1.0);
  x = std::move(y);
  EXPECT_EQ(x[0], 5.0);
}

}  // namespace

}  // namespace codesign
