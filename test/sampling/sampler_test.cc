// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "sampling/sobol.h"

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr SamplerKind kAll[] = {SamplerKind::kSobol, SamplerKind::kLatinHypercube, SamplerKind::kRandom};

TEST(UnitPoints, LieInsideTheCubeAndFollowTheSeed) {
  for (const SamplerKind kind : kAll) {
    const MatrixXd points = unit_points(kind, 100, 3, 1);
    ASSERT_EQ(points.rows(), 100);
    ASSERT_EQ(points.cols(), 3);
    EXPECT_GT(points.minCoeff(), 0.0);
    EXPECT_LT(points.maxCoeff(), 1.0);
    EXPECT_EQ(points, unit_points(kind, 100, 3, 1));
    EXPECT_NE(points, unit_points(kind, 100, 3, 2));
  }
}

TEST(UnitPoints, MayBeNoneOrWithoutCoordinates) {
  for (const SamplerKind kind : kAll) {
    EXPECT_EQ(unit_points(kind, 0, 2, 1).rows(), 0);
    EXPECT_EQ(unit_points(kind, 5, 0, 1).rows(), 5);
  }
}

TEST(UnitPoints, ComeInPartsAsTheSameNumbers) {
  for (const SamplerKind kind : kAll) {
    const PointSequence fill = point_sequence(kind, 10, 3, 5);
    MatrixXd parts(10, 3);
    for (const auto& [first, count] : {std::pair<Index, Index>{0, 1}, {1, 6}, {7, 0}, {7, 3}}) {
      MatrixXd part(count, 3);
      fill(&part);
      parts.middleRows(first, count) = part;
    }
    EXPECT_EQ(parts, unit_points(kind, 10, 3, 5));
  }
}

TEST(UnitPoints, SobolIsTheScrambledSequence) { EXPECT_EQ(unit_points(SamplerKind::kSobol, 9, 4, 3), sobol_points(9, 4, 3)); }

// The first raw numbers of mt19937 with its default seed 5489 are 3499211612, 581869302, 3890346734 and 3586334585.
TEST(UnitPoints, RandomNumbersAreThoseOfMersenneTwister) {
  const MatrixXd points = unit_points(SamplerKind::kRandom, 1, 2, 5489);
  EXPECT_EQ(points(0, 0), ((3499211612u >> 6) * 67108864.0 + (581869302u >> 6) + 0.5) / 4503599627370496.0);
  EXPECT_EQ(points(0, 1), ((3890346734u >> 6) * 67108864.0 + (3586334585u >> 6) + 0.5) / 4503599627370496.0);
}

TEST(UnitPoints, MoreRandomPointsBeginWithTheSame) {
  EXPECT_EQ(unit_points(SamplerKind::kRandom, 30, 3, 4).topRows(10), unit_points(SamplerKind::kRandom, 10, 3, 4));
}

TEST(UnitPoints, RandomNumbersAreUniformAndIndependent) {
  const MatrixXd x = unit_points(SamplerKind::kRandom, 20000, 2, 1).array() - 0.5;
  const double error = 4.0 / std::sqrt(20000.0);
  EXPECT_NEAR(x.col(0).mean(), 0.0, error * std::sqrt(1.0 / 12.0));
  EXPECT_NEAR(x.col(1).cwiseAbs2().mean(), 1.0 / 12.0, error * std::sqrt(1.0 / 180.0));
  EXPECT_NEAR(x.col(0).cwiseProduct(x.col(1)).mean(), 0.0, error / 12.0);
}

TEST(UnitPoints, LatinHypercubeHasOnePointInEachInterval) {
  for (const int count : {1, 2, 7, 100, 1000}) {
    const MatrixXd points = unit_points(SamplerKind::kLatinHypercube, count, 5, 3);
    for (Index j = 0; j < 5; ++j) {
      std::vector<int> counts(static_cast<std::size_t>(count), 0);
      for (Index i = 0; i < count; ++i) ++counts[static_cast<std::size_t>(points(i, j) * count)];
      for (const int n : counts) EXPECT_EQ(n, 1);
    }
  }
}

// Orders of the columns are independent of each other and places in the intervals of the orders.
TEST(UnitPoints, ColumnsOfALatinHypercubeAreUncorrelated) {
  const MatrixXd x = unit_points(SamplerKind::kLatinHypercube, 4000, 3, 1).array() - 0.5;
  const MatrixXd correlation = 12.0 * x.transpose() * x / 4000.0;
  EXPECT_LT((correlation - MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 4.0 / std::sqrt(4000.0));
}

// The bits behind the numbers, from another program: 2 of the interval, 32 of the place in it.
TEST(UnitPoints, LatinHypercubeIsTheSameEverywhere) {
  const MatrixXd points = unit_points(SamplerKind::kLatinHypercube, 4, 2, 1);
  MatrixXd expected(4, 2);
  expected << 4005303368, 4691558544, 12885393151, 10293235841, 9140224905, 799981516, 5593475787, 14550965831;
  EXPECT_EQ(points, ((expected.array() + 0.5) * 0x1p-34).matrix());
}

}  // namespace
}  // namespace codesign
