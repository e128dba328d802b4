// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sampling/sampler.h"

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr SamplerKind kAll[] = {SamplerKind::kSobol, SamplerKind::kLatinHypercube,
                                SamplerKind::kRandom};

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

TEST(UnitPoints, SobolIsTheScrambledSequence) {
  EXPECT_EQ(unit_points(SamplerKind::kSobol, 9, 4, 3), sobol_points(9, 4, 3));
}

// The first raw numbers of mt19937 with its default seed 5489 are 3499211612, 581869302, 3890346734
// and 3586334585.
TEST(UnitPoints, RandomNumbersAreThoseOfMersenneTwister) {
  const MatrixXd points = unit_points(SamplerKind::kRandom, 1, 2, 5489);
  EXPECT_EQ(points(0, 0),
            ((3499211612u >> 6) * 67108864.0 + (581869302u >> 6) + 0.5) / 4503599627370496.0);
  EXPECT_EQ(points(0, 1),
            ((3890346734u >> 6) * 67108864.0 + (3586334585u >> 6) + 0.5) / 4503599627370496.0);
}

TEST(UnitPoints, MoreRandomPointsBeginWithTheSame) {
  EXPECT_EQ(unit_points(SamplerKind::kRandom, 30, 3, 4).topRows(10),
            unit_points(SamplerKind::kRandom, 10, 3, 4));
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
  EXPECT_LT((correlation - MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(),
            4.0 / std::sqrt(4000.0));
}

// The bits behind the numbers, from another program: 2 of the interval, 32 of the place in it.
TEST(UnitPoints, LatinHypercubeIsTheSameEverywhere) {
  const MatrixXd points = unit_points(SamplerKind::kLatinHypercube, 4, 2, 1);
  MatrixXd expected(4, 2);
  expected << 4005303368, 4691558544, 12885393151, 10293235841, 9140224905, 799981516, 5593475787,
      14550965831;
  EXPECT_EQ(points, ((expected.array() + 0.5) * 0x1p-34).matrix());
}

using Eigen::Index;
using Eigen::MatrixXd;

// Number of points in each box of 2^a x 2^b equal ones, of columns j and k.
std::vector<int> count_in_boxes(const MatrixXd& points, Index j, int a, Index k, int b) {
  std::vector<int> counts(std::size_t{1} << (a + b), 0);
  for (Index i = 0; i < points.rows(); ++i) {
    const double row = std::floor(std::ldexp(points(i, j), a)),
                 column = std::floor(std::ldexp(points(i, k), b));
    ++counts[static_cast<std::size_t>(std::ldexp(row, b) + column)];
  }
  return counts;
}

// Root mean square over seeds of the error of the mean of a smooth function whose mean is 1.
double error_of_mean(int count) {
  constexpr int kSeeds = 32;
  double sum = 0.0;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const MatrixXd u = sobol_points(count, 4, seed);
    double mean = 0.0;
    for (Index i = 0; i < count; ++i)
      mean += (u.row(i).array() * u.row(i).array() + 2.0 / 3.0).prod() / count;
    sum += (mean - 1.0) * (mean - 1.0) / kSeeds;
  }
  return std::sqrt(sum);
}

// The bits of the first points, from another program: direction numbers of Joe and Kuo's file, in
// the order of Gray's code, scrambled with the first raw numbers of mt19937.
TEST(Sobol, NumbersAreTheSameEverywhere) {
  const MatrixXd points = sobol_points(4, 3, 1);
  MatrixXd expected(4, 3);
  expected << 2413224618, 4271331633, 997917474,  //
      1892821780, 1037488066, 2630947230,         //
      290766216, 2603241826, 1655649079,          //
      3269440732, 1704081048, 3552360037;
  EXPECT_EQ(points, ((expected.array() + 0.5) * 0x1p-32).matrix());
}

TEST(Sobol, ProjectionsOnOneColumnAreStratified) {
  for (const int k : {0, 1, 5, 10}) {
    const MatrixXd points = sobol_points(1 << k, 40, 7);
    for (Index j = 0; j < points.cols(); ++j) {
      for (const int n : count_in_boxes(points, j, k, j, 0))
        EXPECT_EQ(n, 1) << "column " << j << " of 2^" << k;
    }
  }
}

// Columns 0 and 1 are a (0, 2)-sequence: one point in each box of area 1 / N, whatever its shape.
TEST(Sobol, FirstTwoColumnsAreANet) {
  const MatrixXd points = sobol_points(256, 2, 3);
  for (int a = 0; a <= 8; ++a) {
    for (const int n : count_in_boxes(points, 0, a, 1, 8 - a)) EXPECT_EQ(n, 1) << a;
  }
}

// Joe and Kuo chose their numbers so that pairs of columns are spread well early: 64 points over 4
// x 4 boxes.
TEST(Sobol, LaterColumnsAreSpreadToo) {
  const MatrixXd points = sobol_points(64, 6, 11);
  for (Index j = 0; j < 6; ++j) {
    for (Index k = 0; k < j; ++k) {
      for (const int n : count_in_boxes(points, j, 2, k, 2)) EXPECT_EQ(n, 4) << j << " " << k;
    }
  }
}

TEST(Sobol, ALargerSetContainsTheSmaller) {
  const MatrixXd small = sobol_points(20, 3, 5), large = sobol_points(50, 7, 5);
  EXPECT_EQ(large.topLeftCorner(20, 3), small);
}

TEST(Sobol, SeedsGiveOtherPointsInsideTheCube) {
  const MatrixXd a = sobol_points(128, 5, 1), b = sobol_points(128, 5, 2);
  EXPECT_EQ(a, sobol_points(128, 5, 1));
  EXPECT_TRUE((a.array() != b.array()).all());
  EXPECT_GT(a.minCoeff(), 0.0);
  EXPECT_LT(a.maxCoeff(), 1.0);
}

// Scrambled points are uniformly distributed: the mean over seeds of any one point is 1/2, within
// four standard errors.
TEST(Sobol, EachPointIsUniformOverSeeds) {
  constexpr int kSeeds = 2000;
  MatrixXd mean = MatrixXd::Zero(4, 2), square = mean;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const MatrixXd points = sobol_points(4, 2, seed);
    mean += points / kSeeds;
    square += points.cwiseAbs2() / kSeeds;
  }
  EXPECT_LT((mean.array() - 0.5).abs().maxCoeff(), 4.0 * std::sqrt(1.0 / 12.0 / kSeeds));
  EXPECT_LT((square.array() - 1.0 / 3.0).abs().maxCoeff(), 4.0 * std::sqrt(4.0 / 45.0 / kSeeds));
}

// With 16 times as many points the error of random ones is a fourth, here a thirtieth; it begins
// smaller, too: 0.005 instead of 0.075.
TEST(Sobol, MeansOfSmoothFunctionsConvergeFast) {
  const double coarse = error_of_mean(64), fine = error_of_mean(1024);
  EXPECT_LT(fine, coarse / 16.0);
  EXPECT_LT(fine, 3e-4);
}

TEST(Sobol, EdgesOfTheArguments) {
  EXPECT_EQ(sobol_points(3, 0, 1).rows(), 3);
  EXPECT_EQ(sobol_points(0, 3, 1).rows(), 0);
  EXPECT_EQ(sobol_points(2, kMaxSobolDimension, 1).cols(), kMaxSobolDimension);
  EXPECT_THROW(sobol_points(1, kMaxSobolDimension + 1, 1), std::invalid_argument);
}

}  // namespace

}  // namespace codesign
