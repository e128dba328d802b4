// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_period.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linear/flowing_cases.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

/// x' = -2 x + h + w, y = 3 x + 0.5 w; each 0.4 s h becomes -x + 0.2 w.
FlowingSpace held_state() {
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2, 2), B = Eigen::MatrixXcd::Zero(2, 1),
                   C = Eigen::MatrixXcd::Zero(1, 2), J = Eigen::MatrixXcd::Identity(2, 2),
                   G = Eigen::MatrixXcd::Zero(2, 1);
  A(0, 0) = -2.0;
  A(0, 1) = B(0, 0) = 1.0;
  C(0, 0) = 3.0;
  J.row(1) << -1.0, 0.0;
  G(1, 0) = 0.2;
  return {A, B, C, 0.5, {J}, {G}, {0.4}, {0}};
}

// With w = K 3 x, K = (k - 1)/(1 - 0.5 (k - 1)): x' = a x + h, h = g x.
TEST(FlowingPeriod, MapByClosedForm) {
  for (const Complex k : {Complex(1.0), Complex(0.3), Complex(0.6, -0.5)}) {
    const Complex K = (k - 1.0) / (1.0 - 0.5 * (k - 1.0)), a = -2.0 + 3.0 * K, g = -1.0 + 0.6 * K;
    const Complex flow = std::exp(0.4 * a), of_held = (flow - 1.0) / a;
    const Eigen::MatrixXcd map = map_with(held_state(), k);
    EXPECT_LT(std::abs(map(0, 0) - (flow + of_held * g)), 1e-14);
    EXPECT_LT(std::abs(map(1, 0) - g), 1e-14);
    EXPECT_EQ(map(0, 1), 0.0);
  }
}

// Words in place of matrices: the order stays, and what repeats is combined once.
TEST(FlowingPeriod, CombinesInOrder) {
  int combined = 0;
  const auto then = [&combined](const std::string& first, const std::string& next) {
    ++combined;
    return first + next;
  };
  const std::vector<std::string> letters{"a", "b", "c"};
  EXPECT_EQ(in_order(letters, {2}, then), "c");
  EXPECT_EQ(in_order(letters, {0, 1, 0, 1, 0, 1, 2}, then), "abababc");
  EXPECT_EQ(combined, 1 + 2 + 1);
}

TEST(FlowingPeriod, MapMovesWithFactorAndDesign) {
  const Complex k(0.7, -0.4), step(1e-6, 0.0);
  const FlowingSpace at = values_of(damped_cart()), above = values_of(damped_cart(1e-6)),
                     below = values_of(damped_cart(-1e-6));
  const Eigen::MatrixXcd by_factor =
      (map_with(at, k + step) - map_with(at, k - step)) / (2.0 * step);
  EXPECT_LT((map_by_factor(at, k) - by_factor).norm(), 1e-8 * by_factor.norm());
  const Eigen::MatrixXcd by_design = (map_with(above, k) - map_with(below, k)) / (2.0 * step);
  EXPECT_LT((map_along(at, k, changes_of(moving_cart())) - by_design).norm(),
            1e-8 * by_design.norm());
  EXPECT_GT(by_design.norm(), 0.1);
}

// With jumps that change nothing the part is C (jw - A)^-1 B + D, of the opened loop H/(1 + H).
TEST(FlowingPeriod, PartOfALoopWithoutJumpsIsItsTransferFunction) {
  FlowingSpace space = values_of(damped_cart());
  for (Eigen::MatrixXcd& J : space.J) J.setIdentity();
  space.A.bottomRows(2).setZero();
  space.A.col(3).setZero();
  space.A(3, 3) = space.A(4, 4) = -1.0;
  space.D = 0.3;
  for (const double w : {0.3, 5.0, 80.0}) {
    const Eigen::MatrixXcd M = Complex(0.0, w) * Eigen::MatrixXcd::Identity(5, 5) - space.A;
    const Complex H = (space.C * complex_solution(M, space.B))(0, 0) + 0.3;
    EXPECT_LT(std::abs(part_at(space, w) - H), 1e-13 * (1.0 + std::abs(H)));
    EXPECT_LT(std::abs(part_at(space.opened(), w) - H / (1.0 + H)), 1e-12);
  }
}

// A hold alone: y = h of w sampled each T is e^{-jwT/2} sin(wT/2)/(wT/2).
TEST(FlowingPeriod, PartOfAHold) {
  const Eigen::MatrixXcd zero = Eigen::MatrixXcd::Zero(1, 1), one = Eigen::MatrixXcd::Ones(1, 1);
  const FlowingSpace hold{zero, zero, one, 0.0, {zero}, {one}, {0.2}, {0}};
  for (const double w : {0.5, 10.0, 40.0}) {
    const Complex expected = std::sin(0.1 * w) / (0.1 * w) * std::polar(1.0, -0.1 * w);
    EXPECT_LT(std::abs(part_at(hold, w) - expected), 1e-14);
  }
}

TEST(FlowingPeriod, PartMovesWithFrequencyAndDesign) {
  const double w = 6.0, step = 1e-5;
  const FlowingSpace at = values_of(damped_cart());
  const Complex by_w = (part_at(at, w + step) - part_at(at, w - step)) / (2.0 * step);
  EXPECT_LT(std::abs(part_by_frequency(at, w) - by_w), 1e-8);
  const Complex by_design =
      (part_at(values_of(damped_cart(step)), w) - part_at(values_of(damped_cart(-step)), w)) /
      (2.0 * step);
  EXPECT_LT(std::abs(part_along(at, w, changes_of(moving_cart())) - by_design), 1e-8);
  EXPECT_GT(std::abs(by_design), 1e-2);
}

// An oscillator of 30 rad/s in a period of 0.5 s: its angle per period is known up to turns.
TEST(FlowingPeriod, TheSinusoidOfAMotion) {
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2, 2), C = Eigen::MatrixXcd::Zero(1, 2);
  A(0, 1) = C(0, 0) = 1.0;
  A(1, 0) = -900.0;
  const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(2, 1);
  const FlowingSpace space{A, none, C, 0.0, {Eigen::MatrixXcd::Identity(2, 2)}, {none}, {0.5}, {0}};
  Eigen::VectorXcd motion(2);
  motion << 1.0, Complex(0.0, -30.0);
  EXPECT_NEAR(largest_sinusoid(space, 1.0, motion, std::remainder(-15.0, 2.0 * std::acos(-1.0))),
              -30.0, 1e-9);
}

}  // namespace
}  // namespace codesign
