// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/pade.h"

#include <gtest/gtest.h>

#include <complex>

namespace codesign {
namespace {

using Complex = std::complex<double>;

Complex response(int order, double delay, const Complex& s) {
  Complex value = 1.0;
  for (const PadeSection& section : pade_sections(order)) {
    EXPECT_TRUE(is_pade(section.kind));
    const FilterShape<double> h =
        section.kind->shape.of<double>(FilterNumbers<double>{delay, section.size, section.damping});
    const Complex x = s / h.rate;
    value *= section.kind->order == 1
                 ? (h.lead * x + 1.0) / (x + 1.0)
                 : (h.lead * x * x + h.middle * x + 1.0) / (x * x + h.damping * x + 1.0);
  }
  return value;
}

// (1 - x/2)/(1 + x/2), (1 - x/2 + x^2/12)/(1 + x/2 + x^2/12), and of third order x^3/120.
TEST(Pade, OfLowOrders) {
  const double T = 0.3;
  const Complex s(1.0, 7.0), x = T * s;
  EXPECT_LT(std::abs(response(1, T, s) - (1.0 - x / 2.0) / (1.0 + x / 2.0)), 1e-13);
  EXPECT_LT(
      std::abs(response(2, T, s) - (1.0 - x / 2.0 + x * x / 12.0) / (1.0 + x / 2.0 + x * x / 12.0)),
      1e-13);
  EXPECT_LT(std::abs(response(3, T, s) - (1.0 - x / 2.0 + x * x / 10.0 - x * x * x / 120.0) /
                                             (1.0 + x / 2.0 + x * x / 10.0 + x * x * x / 120.0)),
            1e-13);
}

TEST(Pade, ApproachesTheDelay) {
  for (int order = 1; order <= kMostPade; ++order) {
    const Complex far = response(order, 0.5, Complex(0.0, 2.0 * order));
    EXPECT_NEAR(std::abs(far), 1.0, 1e-10);
    EXPECT_LT(std::abs(far - std::exp(Complex(0.0, -1.0 * order))), 0.08) << order;
  }
  EXPECT_LT(std::abs(response(kMostPade, 1.0, Complex(0.0, 3.0)) - std::exp(Complex(0.0, -3.0))),
            1e-11);
}

}  // namespace
}  // namespace codesign
