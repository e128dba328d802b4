// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_norm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/flowing_cases.h"
#include "math/differences.h"
#include "math/linear_systems.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

// 1/(s^2 + 2 zeta s + 1) amplifies most by 1/(2 zeta sqrt(1 - zeta^2)), whatever the period.
TEST(FlowingNorm, OfAResonance) {
  const double zeta = 0.1;
  MatrixXcd A(2, 2), B(2, 1), C(1, 2);
  A << 0.0, 1.0, -1.0, -2.0 * zeta;
  B << 0.0, 1.0;
  C << 1.0, 0.0;
  const MatrixXcd nothing = MatrixXcd::Identity(2, 3);
  const FlowingNorm norm(
      {A, B, C, MatrixXcd::Zero(1, 1), {{{nothing, 0.3}, {nothing, 0.4}}, {0, 1}}}, 0.0);
  const auto peak = norm.above({1.0, 0.0});
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->value, 0.5 / (zeta * std::sqrt(1.0 - zeta * zeta)), 1e-12);
  EXPECT_NEAR(peak->angle, 0.7 * std::sqrt(1.0 - 2.0 * zeta * zeta), 1e-8);
  EXPECT_FALSE(norm.above({5.1, 0.0}));
}

// An integral that begins anew each T: 2 T/pi, that of Volterra's operator (Halmos, problem 188),
// whatever the angle.
TEST(FlowingNorm, OfAnIntegralThatIsReset) {
  const MatrixXcd zero = MatrixXcd::Zero(1, 1), one = MatrixXcd::Ones(1, 1);
  const ComplexSpace reset{zero, one, one, zero, {{{MatrixXcd::Zero(1, 2), 0.8}}, {0}}};
  const auto peak = FlowingNorm(reset, 0.0).above({0.1, 0.0});
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->value, 1.6 / std::acos(-1.0), 1e-12);
}

/// The singular value of signals that are constant on `count` parts of each half period.
double lifted(const ComplexSpace& space, double shift, double angle, Eigen::Index count) {
  const Eigen::Index n = space.A.rows(), all = 2 * count;
  MatrixXcd flow = MatrixXcd::Zero(n + 2, n + 2);
  flow.topLeftCorner(n, n) = space.A;
  flow.block(0, n, n, 1) = space.B;
  flow.block(n + 1, 0, 1, n) = space.C;
  const double time = 0.05 / static_cast<double>(count);
  const MatrixXcd step = matrix_exponential(MatrixXcd(flow * time));
  MatrixXcd x = MatrixXcd::Identity(n, n + all), y = MatrixXcd::Zero(all, n + all);
  for (Eigen::Index k = 0; k < all; ++k) {
    if (k % count == 0) x = (space.pieces.different[k == 0 ? 0 : 1].jump.leftCols(n) * x).eval();
    y.row(k) = step.block(n + 1, 0, 1, n) * x / time;
    y(k, n + k) += step(n + 1, n) / time + shift;
    x = (step.topLeftCorner(n, n) * x).eval();
    x.col(n + k) += step.block(0, n, n, 1);
  }
  const MatrixXcd M = std::polar(1.0, angle) * MatrixXcd::Identity(n, n) - x.leftCols(n);
  const MatrixXcd H = y.rightCols(all) + y.leftCols(n) * complex_solution(M, x.rightCols(all));
  return largest_gain(H).value;
}

// Coarse signals fall short by the square of their parts.
TEST(FlowingNorm, AgainstSignalsInSteps) {
  for (const double shift : {0.0, 1.0}) {
    const auto peak = FlowingNorm(damped_cart(), shift).above({1.0 + 1e-6 * (1.0 - shift), 0.0});
    ASSERT_TRUE(peak);
    const double coarse = lifted(damped_cart(), shift, peak->angle, 8),
                 fine = lifted(damped_cart(), shift, peak->angle, 16);
    EXPECT_NEAR(fine + (fine - coarse) / 3.0, peak->value, 1e-5);
    EXPECT_LT(lifted(damped_cart(), shift, peak->angle + 0.05, 16), fine);
    EXPECT_LT(lifted(damped_cart(), shift, peak->angle - 0.05, 16), fine);
  }
}

TEST(FlowingNorm, Derivatives) {
  for (const double shift : {0.0, 1.0}) {
    const auto largest = [shift](double step) {
      return FlowingNorm(damped_cart(step), shift).above({0.5 + 0.5 * shift, 0.0});
    };
    const auto peak = largest(0.0);
    ASSERT_TRUE(peak);
    const RiddersDerivative reference =
        ridders_derivative([&](double step) { return largest(step)->value; }, 0.0, 0.05);
    EXPECT_NEAR(FlowingNorm(moving_cart(), shift).derivative_of(*peak), reference.value,
                1e-8 + 10.0 * reference.error);
    EXPECT_LT(reference.error, 1e-7);
  }
}

// Nothing bounds an integrator; of nothing there is nothing above nothing.
TEST(FlowingNorm, WithoutABound) {
  const MatrixXcd zero = MatrixXcd::Zero(1, 1), one = MatrixXcd::Ones(1, 1);
  ComplexSpace growing{one, one, one, zero, {{{MatrixXcd::Identity(1, 2), 1.0}}, {0}}};
  const auto peak = FlowingNorm(growing, 0.0).above({1.0, 0.0});
  ASSERT_TRUE(peak);
  EXPECT_TRUE(std::isinf(peak->value));
  growing.C = zero;
  EXPECT_FALSE(FlowingNorm(growing, 0.0).above({0.0, 0.0}));
}

TEST(FlowingNorm, OfFastSignals) {
  ComplexSpace cart = damped_cart();
  cart.D(0, 0) = Complex(-1.5, 2.0 * ComplexSpace::kStep);
  EXPECT_EQ(FlowingNorm(cart, 1.0).of_fast_signals(), 0.5);
  EXPECT_NEAR(FlowingNorm(cart, 1.0).derivative_of_fast_signals(), -2.0, 1e-15);
}

}  // namespace
}  // namespace codesign
