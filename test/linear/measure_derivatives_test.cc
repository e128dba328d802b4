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

/// The derivative of the place that decides, by a change of the matrix.
double first_derivative(const Eigen::MatrixXd& A, Kind kind, const Eigen::MatrixXd& change,
                        double period = 0.0) {
  const std::vector<Pole> poles = poles_of_matrix(A, period);
  return derivative_of(ranked(poles, kind, 1.0).front(), poles, kind, period, A, change);
}

/// A matrix with one entry.
Eigen::MatrixXd entry(Eigen::Index size, Eigen::Index row, Eigen::Index column, double value) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  matrix(row, column) = value;
  return matrix;
}

// s^2 + d s + p at d = 2, p = 1: both poles at -1 move in one way, their mean is -d/2.
TEST(MeasureDerivatives, OfPolesThatMeetInOneMotion) {
  Eigen::MatrixXd A(2, 2);
  A << 0.0, 1.0, -1.0, -2.0;
  const std::vector<Pole> poles = poles_of_matrix(A);
  const std::vector<PoleCluster> places = ranked(poles, Kind::kGrowth, 1.0);
  ASSERT_EQ(places.size(), static_cast<std::size_t>(LinearMeasure::kPoles));
  EXPECT_NEAR(value_of(places[0], Kind::kGrowth, 0.0), -1.0, 1e-14);
  EXPECT_NEAR(value_of(places[0], Kind::kDampingRatio, 0.0), 1.0, 1e-14);
  const Eigen::MatrixXd by_d = entry(2, 1, 1, -1.0), by_p = entry(2, 1, 0, -1.0);
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, by_d), -0.5, 1e-12);
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, by_p), 0.0, 1e-12);
  EXPECT_NEAR(first_derivative(A, Kind::kDampingRatio, by_d), 0.0, 1e-12);
}

// s^3 + a s^2 + ... at (s + 1)^3: the mean is -a/3; beside another pole at -2.
TEST(MeasureDerivatives, OfATriplePoleBesideAnother) {
  Eigen::MatrixXd A = entry(4, 3, 3, -2.0);
  A.topLeftCorner(3, 3) << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0, -3.0, -3.0;
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, entry(4, 2, 2, -1.0)), -1.0 / 3.0, 1e-11);
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, entry(4, 2, 1, -1.0)), 0.0, 1e-11);
}

// Two pairs at -1 + 2j that meet in one motion.
TEST(MeasureDerivatives, OfPairsThatMeet) {
  Eigen::MatrixXd A(4, 4);
  A << -1.0, 2.0, 1.0, 0.0, -2.0, -1.0, 0.0, 1.0, 0.0, 0.0, -1.0, 2.0, 0.0, 0.0, -2.0, -1.0;
  Eigen::MatrixXd change = Eigen::MatrixXd::Zero(4, 4);
  change.topLeftCorner(2, 2).setIdentity();
  change(2, 0) = 0.7;  // splits them and moves no mean
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, change), 0.5, 1e-11);
}

// z^2 - z + c at c = 1/4: the mean of ln z/T is ln c/(2 T). And z^2 + z + c, on the other side.
TEST(MeasureDerivatives, OfSampledPolesThatMeet) {
  for (const double side : {1.0, -1.0}) {
    Eigen::MatrixXd A(2, 2);
    A << side, -0.25, 1.0, 0.0;
    const Eigen::MatrixXd by_c = entry(2, 0, 1, -1.0);
    EXPECT_NEAR(first_derivative(A, Kind::kGrowth, by_c, 0.1), 1.0 / (2.0 * 0.25 * 0.1), 1e-9);
    EXPECT_NEAR(first_derivative(A, Kind::kRadius, by_c, 0.1), 1.0, 1e-10);
  }
}

// Two masses alike that do not know each other: the mean of their poles has one.
TEST(MeasureDerivatives, OfPolesOfMachinesAlike) {
  const Eigen::MatrixXd A = Eigen::Vector2d(-1.0, -1.0).asDiagonal(),
                        change = Eigen::Vector2d(2.0, 0.0).asDiagonal();
  EXPECT_NEAR(first_derivative(A, Kind::kGrowth, change), 1.0, 1e-12);
}

TEST(MeasureDerivatives, TellPolesThatAreNotApart) {
  const Eigen::MatrixXd A = Eigen::Vector3d(-1.0, -2.0, -2.5).asDiagonal();
  const PoleCluster cluster{-1.5, {0, 1}, false};
  EXPECT_TRUE(std::isnan(derivative_of(cluster, poles_of_matrix(A), Kind::kGrowth, 0.0, A, A)));
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

// 0.2/(s^2 + 0.2 s + 1) peaks at 1/sqrt(0.99), below the 3 of 3 s/(s + 1e6).
TEST(MeasureDerivatives, OfAPeakBelowThatOfFastSignals) {
  ComplexSpace closed;
  closed.A = Eigen::MatrixXcd::Zero(3, 3);
  closed.A.topLeftCorner(2, 2) << 0.0, 1.0, -1.0, -0.2;
  closed.A(2, 2) = -1e6;
  closed.B = Eigen::Vector3cd(0.0, 1.0, 1.0);
  closed.C = Eigen::RowVector3cd(std::complex<double>(0.2, ComplexSpace::kStep), 0.0, -3e6);
  closed.D = Eigen::MatrixXcd::Constant(1, 1, 3.0);
  const double peak = 1.0 / std::sqrt(0.99);
  EXPECT_NEAR(
      derivative_of({peak, std::sqrt(0.98)}, Kind::kComplementarySensitivity, 0.0, closed, 0.0),
      peak / 0.2, 1e-4);
  closed.C.imag() *= 0.0;
  closed.D(0, 0) = std::complex<double>(3.0, ComplexSpace::kStep);
  EXPECT_NEAR(derivative_of({3.0, 1e9}, Kind::kComplementarySensitivity, 0.0, closed, 0.0), 1.0,
              1e-14);
}

// z = 1 - k T: s = ln z/T, radius |z|.
TEST(MeasureDerivatives, OfASampledPole) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(1, 1, 0.8),
                        change = Eigen::MatrixXd::Constant(1, 1, -0.1);
  const std::vector<Pole> poles = poles_of_matrix(A, 0.1);
  const PoleCluster place = ranked(poles, Kind::kRadius, 1.0).front();
  EXPECT_NEAR(value_of(place, Kind::kRadius, 0.1), 0.8, 1e-14);
  EXPECT_NEAR(derivative_of(place, poles, Kind::kRadius, 0.1, A, change), -0.1, 1e-14);
  EXPECT_NEAR(derivative_of(place, poles, Kind::kGrowth, 0.1, A, change), -0.1 / 0.08, 1e-12);
}

}  // namespace
}  // namespace codesign
