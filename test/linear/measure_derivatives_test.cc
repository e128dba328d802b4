// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/measure_derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

using Kind = LinearMeasure::Kind;

std::vector<Pole> poles_of_matrix(const Eigen::MatrixXd& A, double period = 0.0) {
  StateSpace system;
  system.A = A;
  system.period = period;
  return poles_of(system);
}

// s^2 + 2 s + 1: both poles at -1 move in one way, and have no derivative.
TEST(MeasureDerivatives, TellPolesThatMeetInOneMotion) {
  Eigen::MatrixXd A(2, 2), by_damping(2, 2);
  A << 0.0, 1.0, -1.0, -2.0;
  by_damping << 0.0, 0.0, 0.0, -1.0;
  const std::vector<Pole> poles = poles_of_matrix(A);
  const std::vector<PoleCluster> places = ranked(poles, Kind::kGrowth, 1.0);
  ASSERT_EQ(places.size(), static_cast<std::size_t>(LinearMeasure::kPoles));
  EXPECT_NEAR(value_of(places[0], Kind::kGrowth, 0.0), -1.0, 1e-7);
  EXPECT_TRUE(std::isnan(derivative_of(places[0], poles, Kind::kGrowth, 0.0, by_damping)));
}

// Two masses alike that do not know each other: the mean of their poles has one.
TEST(MeasureDerivatives, OfPolesOfMachinesAlike) {
  const Eigen::MatrixXd A = Eigen::Vector2d(-1.0, -1.0).asDiagonal(),
                        change = Eigen::Vector2d(2.0, 0.0).asDiagonal();
  const std::vector<Pole> poles = poles_of_matrix(A);
  const std::vector<PoleCluster> places = ranked(poles, Kind::kGrowth, 1.0);
  EXPECT_NEAR(derivative_of(places[0], poles, Kind::kGrowth, 0.0, change), 1.0, 1e-12);
}

TEST(MeasureDerivatives, RankThePolesThatDecide) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(4, 4);
  A << 0.0, 1.0, 0.0, 0.0, -4.0, -2.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0;
  const std::vector<Pole> poles = poles_of_matrix(A);
  const auto numbers = [&](Kind kind) {
    std::vector<double> values;
    for (const PoleCluster& place : ranked(poles, kind, 1.0))
      values.push_back(value_of(place, kind, 0.0));
    return values;
  };
  const std::vector<double> growth = numbers(Kind::kGrowth);
  const double expected[] = {0.0, -0.5, -1.0, -1.0, -1.0, -1.0};
  for (std::size_t k = 0; k < growth.size(); ++k) EXPECT_NEAR(growth[k], expected[k], 1e-12) << k;
  const std::vector<double> damping = numbers(Kind::kDampingRatio);
  EXPECT_NEAR(damping[0], 0.5, 1e-12);
  EXPECT_NEAR(damping[1], 0.5, 1e-12);
  EXPECT_NEAR(damping[2], 1.0, 1e-12) << "the pole at zero does not count";
}

// z = 1 - k T: s = ln z/T, radius |z|.
TEST(MeasureDerivatives, OfASampledPole) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(1, 1, 0.8),
                        change = Eigen::MatrixXd::Constant(1, 1, -0.1);
  const std::vector<Pole> poles = poles_of_matrix(A, 0.1);
  const PoleCluster place = ranked(poles, Kind::kRadius, 1.0).front();
  EXPECT_NEAR(value_of(place, Kind::kRadius, 0.1), 0.8, 1e-14);
  EXPECT_NEAR(derivative_of(place, poles, Kind::kRadius, 0.1, change), -0.1, 1e-14);
  EXPECT_NEAR(derivative_of(place, poles, Kind::kGrowth, 0.1, change), -0.1 / 0.08, 1e-12);
}

}  // namespace
}  // namespace codesign
