// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/opened_period.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/frequency_search.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

/// v(k+1) = v(k) + T u(k), y(k) = -g v(k), three samples per period, closed by u = w + y:
/// v(k+1) = a v(k) + T w(k) with a = 1 - g T.
struct Cart {
  static constexpr int kSamples = 3;
  const double gain = 4.0, step = 0.1, a = 1.0 - gain * step;
  Eigen::MatrixXd A = Eigen::MatrixXd::Constant(1, 1, a*a*a),
                  B = Eigen::MatrixXd::Zero(1, kSamples), C = Eigen::MatrixXd::Zero(kSamples, 1),
                  D = Eigen::MatrixXd::Zero(kSamples, kSamples);

  Cart() {
    for (int k = 0; k < kSamples; ++k) {
      B(0, k) = step * std::pow(a, kSamples - 1 - k);
      C(k, 0) = -gain * std::pow(a, k);
      for (int j = 0; j < k; ++j) D(k, j) = -gain * step * std::pow(a, k - 1 - j);
    }
  }
};

TEST(OpenedPeriod, OfAnIntegrator) {
  const Cart cart;
  const OpenedPeriod open(cart.A, cart.B, cart.C, cart.D, 3.0 * cart.step);
  EXPECT_NEAR(open.A(0, 0), 1.0, 1e-15);
  for (int k = 0; k < Cart::kSamples; ++k) {
    EXPECT_NEAR(open.B(0, k), cart.step, 1e-15);
    EXPECT_NEAR(open.C(k, 0), -cart.gain, 1e-14);
    for (int j = 0; j < Cart::kSamples; ++j)
      EXPECT_NEAR(open.D(k, j), j < k ? -cart.gain * cart.step : 0.0, 1e-15);
  }
}

// u = f y: v(k+1) = (1 - f g T) v(k).
TEST(OpenedPeriod, ClosedByAFactorOfGainAndLag) {
  const Cart cart;
  const OpenedPeriod open(cart.A, cart.B, cart.C, cart.D, 3.0 * cart.step);
  for (const Complex factor : {Complex(1.0), Complex(2.5), std::polar(1.0, -0.7)}) {
    const Complex b = 1.0 - factor * cart.gain * cart.step;
    EXPECT_NEAR(std::abs(open.closed_by(factor)(0, 0) - b * b * b), 0.0, 1e-14);
    EXPECT_NEAR(std::abs(open.by_factor(factor)(0, 0) + 3.0 * cart.gain * cart.step * b * b), 0.0,
                1e-14);
    for (int k = 0; k < Cart::kSamples; ++k)
      EXPECT_NEAR(std::abs(open.outputs(factor)(k, 0) + cart.gain * std::pow(b, k)), 0.0, 1e-14);
  }
}

// Of sinusoids that are a turn per period apart each sees itself alone.
TEST(OpenedPeriod, ThePartOfASinusoid) {
  const double period = 0.5, apart = 2.0 * kHalfTurn / period;
  const Eigen::VectorXcd first = sinusoid(3.0, 8, period),
                         second = sinusoid(3.0 + apart, 8, period);
  const Eigen::VectorXcd sum = Complex(1.0, 2.0) * first + Complex(-0.5, 0.25) * second;
  EXPECT_NEAR(std::abs(part_at(first, sum) - Complex(1.0, 2.0)), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(part_at(second, sum) - Complex(-0.5, 0.25)), 0.0, 1e-14);
}

TEST(OpenedPeriod, TheMainFrequencyOfSamples) {
  const double period = 0.5;
  for (const double w : {1.0, 30.0, -45.0, 61.0})
    EXPECT_NEAR(main_frequency(sinusoid(w, 10, period), std::remainder(w * period, 2.0 * kHalfTurn),
                               period),
                w, 1e-9);
}

}  // namespace
}  // namespace codesign
