// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/pole_margins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/frequency_search.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Kind = LinearMeasure::Kind;

constexpr double kStride = 0.5;  // [s] of a period

/// v(k+1) = pole v(k) - factor gain v(k), once per period.
struct ScalarLoop : FactoredLoop {
  ScalarLoop(double of_pole, double of_gain) : pole(of_pole), gain(of_gain) {}
  Eigen::MatrixXcd closed_by(Complex factor) const override {
    return Eigen::MatrixXcd::Constant(1, 1, pole - factor * gain);
  }
  Eigen::MatrixXcd by_factor(Complex) const override {
    return Eigen::MatrixXcd::Constant(1, 1, -gain);
  }
  double frequency_of(Complex, const EigenTriple& motion) const override {
    return std::arg(motion.value) / kStride;
  }
  double pole, gain;
};

LoopMargins margins_with(const ScalarLoop& loop, bool is_stable) {
  LoopMargins margins;
  margins.is_stable = is_stable;
  find_pole_margins(loop, &margins);
  return margins;
}

// |pole - k gain| = 1 at z = -1 and, of a pole outside, at z = 1; |L| = 1 where
// |e^{jwT} - pole| = gain.
TEST(PoleMargins, OfOneState) {
  const double pole = 1.2, gain = 0.9;
  const LoopMargins margins = margins_with({pole, gain}, true);
  EXPECT_NEAR(margins.gain_margin->value, (1.0 + pole) / gain, 1e-12);
  EXPECT_NEAR(margins.gain_margin->frequency, kHalfTurn / kStride, 1e-6);
  EXPECT_NEAR(margins.gain_reduction->value, (pole - 1.0) / gain, 1e-12);
  const double turn = std::acos((1.0 + pole * pole - gain * gain) / (2.0 * pole));
  const double lag = kHalfTurn - std::abs(std::arg(gain / (std::polar(1.0, turn) - pole)));
  EXPECT_NEAR(margins.phase_margin->value, lag, 1e-12);
  EXPECT_NEAR(margins.phase_margin->frequency, turn / kStride, 1e-9);
  EXPECT_NEAR(margins.delay_margin->value, lag * kStride / turn, 1e-9);
}

// The pole of the other sign moves backwards with a lag: the limit is a lead, and a lag of the rest
// of a turn.
TEST(PoleMargins, OfALead) {
  const LoopMargins margins = margins_with({-1.2, -0.9}, true);
  const double turn = kHalfTurn - std::acos((1.0 + 1.44 - 0.81) / 2.4);
  const double lead = std::acos((1.44 + 0.81 - 1.0) / (2.0 * 1.2 * 0.9));
  ASSERT_EQ(margins.all.phases.size(), 1U);
  EXPECT_NEAR(margins.phase_margin->value, lead, 1e-12);
  EXPECT_NEAR(margins.phase_margin->frequency, turn / kStride, 1e-9);
  EXPECT_NEAR(margins.delay_margin->value, (2.0 * kHalfTurn - lead) * kStride / turn, 1e-9);
  // 2 pole gain cos(lead) = pole^2 + gain^2 - 1, both sizes moved along with their signs.
  const double by_pole = 0.7, by_gain = -0.4;
  const MovedBy moved = [&](Complex factor) {
    return Eigen::MatrixXcd::Constant(1, 1, by_pole - factor * by_gain);
  };
  const double a = -1.2, g = -0.9, b = a * a + g * g - 1.0, product = a * by_gain + g * by_pole;
  const double by_cosine =
      (a * by_pole + g * by_gain) / (a * g) - 0.5 * b * product / (a * a * g * g);
  EXPECT_NEAR(pole_margin_derivative(ScalarLoop(-1.2, -0.9), moved, kStride, *margins.phase_margin,
                                     Kind::kPhaseMargin),
              -by_cosine / std::sin(lead), 1e-10);
}

TEST(PoleMargins, OfAnUnstableLoopOnlyAReductionThatHelps) {
  const LoopMargins beyond = margins_with({0.5, 2.0}, false);
  EXPECT_NEAR(beyond.gain_reduction->value, 0.75, 1e-12);
  EXPECT_FALSE(beyond.gain_margin || beyond.phase_margin);
  EXPECT_FALSE(margins_with({1.5, 0.1}, false).gain_reduction);
}

// By pole and gain at once, against the closed forms above.
TEST(PoleMargins, Derivatives) {
  const ScalarLoop loop(1.2, 0.9);
  const LoopMargins margins = margins_with(loop, true);
  const double by_pole = 0.7, by_gain = -0.4;
  const MovedBy moved = [&](Complex factor) {
    return Eigen::MatrixXcd::Constant(1, 1, by_pole - factor * by_gain);
  };
  EXPECT_NEAR(pole_margin_derivative(loop, moved, kStride, *margins.gain_margin, Kind::kGainMargin),
              by_pole / 0.9 - 2.2 / 0.81 * by_gain, 1e-12);
  EXPECT_NEAR(
      pole_margin_derivative(loop, moved, kStride, *margins.gain_reduction, Kind::kGainReduction),
      by_pole / 0.9 - 0.2 / 0.81 * by_gain, 1e-12);
  const auto beside = [&](double step) {
    return margins_with({1.2 + step * by_pole, 0.9 + step * by_gain}, true);
  };
  constexpr double kStep = 1e-4;
  const LoopMargins above = beside(kStep), below = beside(-kStep);
  EXPECT_NEAR(
      pole_margin_derivative(loop, moved, kStride, *margins.phase_margin, Kind::kPhaseMargin),
      (above.phase_margin->value - below.phase_margin->value) / (2.0 * kStep), 1e-6);
  EXPECT_NEAR(
      pole_margin_derivative(loop, moved, kStride, *margins.delay_margin, Kind::kDelayMargin),
      (above.delay_margin->value - below.delay_margin->value) / (2.0 * kStep), 1e-6);
}

}  // namespace
}  // namespace codesign
