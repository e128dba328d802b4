// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "excitation/trajectory_basis.h"

#include <gtest/gtest.h>

#include "math/differences.h"

namespace codesign {
namespace {

ExcitationDescription described(TrajectoryKind kind) {
  ExcitationDescription description;
  description.trajectory = kind;
  description.period = 3.0;
  description.harmonics = 4;
  description.knots = 9;
  return description;
}

class TrajectoryBasisOf : public testing::TestWithParam<TrajectoryKind> {
 protected:
  const TrajectoryBasis basis_{described(GetParam())};
};

TEST_P(TrajectoryBasisOf, BeginsAndEndsAtRest) {
  EXPECT_EQ(basis_.size(), 6);
  for (const double time : {0.0, 3.0, 6.0, 3.0 - 1e-9, 1e-9}) {
    const TrajectoryBasis::Shapes shapes = basis_.at(time);
    for (Eigen::Index k = 0; k < basis_.size(); ++k) {
      EXPECT_NEAR(shapes.value[k], 0.0, 1e-15);
      EXPECT_NEAR(shapes.rate[k], 0.0, 1e-12);
      EXPECT_NEAR(shapes.acceleration[k], 0.0, 1e-6);
    }
  }
}

TEST_P(TrajectoryBasisOf, RatesAndAccelerationsAreTheDerivatives) {
  for (const double time : {0.2, 1.1, 1.6, 2.83})  // between knots
    for (Eigen::Index k = 0; k < basis_.size(); ++k) {
      const auto value = [&](double t) { return basis_.at(t).value[k]; };
      const auto rate = [&](double t) { return basis_.at(t).rate[k]; };
      EXPECT_NEAR(basis_.at(time).rate[k], ridders_derivative(value, time, 0.02).value, 1e-9);
      EXPECT_NEAR(basis_.at(time).acceleration[k], ridders_derivative(rate, time, 0.02).value,
                  1e-8);
    }
}

TEST_P(TrajectoryBasisOf, Repeats) {
  EXPECT_TRUE(basis_.at(1.3).value.isApprox(basis_.at(4.3).value, 1e-12));
  EXPECT_TRUE(basis_.at(1.3).acceleration.isApprox(basis_.at(4.3).acceleration, 1e-12));
}

TEST_P(TrajectoryBasisOf, PlainMotionsDiffer) {
  const Eigen::VectorXd first = basis_.plain(0), second = basis_.plain(1);
  EXPECT_GT(first.norm(), 0.5);
  EXPECT_GT((first.normalized() - second.normalized()).norm(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Both, TrajectoryBasisOf,
                         testing::Values(TrajectoryKind::kFourier, TrajectoryKind::kSpline));

TEST(TrajectoryBasis, SplinesAreOneTogether) {
  // In the middle all four overlapping splines are not zero.
  const TrajectoryBasis basis(described(TrajectoryKind::kSpline));
  for (const double time : {1.0, 1.3, 1.5, 2.0})
    EXPECT_NEAR(basis.at(time).value.sum(), 1.0, 1e-14);
  EXPECT_NEAR(basis.at(4.0 / 6.0).value[0], 2.0 / 3.0, 1e-14) << "in its middle";
}

TEST(TrajectoryBasis, ShortestWaves) {
  EXPECT_DOUBLE_EQ(TrajectoryBasis(described(TrajectoryKind::kFourier)).shortest_wave(), 0.75);
  EXPECT_DOUBLE_EQ(TrajectoryBasis(described(TrajectoryKind::kSpline)).shortest_wave(), 12.0 / 9.0);
}

}  // namespace
}  // namespace codesign
