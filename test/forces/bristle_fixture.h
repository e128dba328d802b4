// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "forces/friction_law.h"
#include "math/differences.h"
#include "mechanism/constants.h"

namespace codesign {

using Complex = std::complex<double>;

template <class T>
FrictionConstants<T> bristle_constants() {
  FrictionConstants<T> c;
  c.mu_static = T(0.5);
  c.mu_dynamic = T(0.4);
  c.transition_velocity = T(0.01);
  c.bristle_stiffness = T(1000.0);
  c.bristle_damping = T(5.0);
  c.dwell_time = T(2.0);
  return c;
}

/// (mu, zeta', s_dw') of a law.
template <class T>
Eigen::Matrix<T, 7, 1> outputs(const Bristle<T>& b) {
  Eigen::Matrix<T, 7, 1> all;
  all << b.mu, b.rate, b.dwell_rate;
  return all;
}

/// Derivatives by the six coefficients, computed with lanes, against the complex step.
template <class LanesLaw, class ComplexLaw>
void expect_parameter_derivatives(const LanesLaw& lanes_law, const ComplexLaw& complex_law) {
  const auto members = [](auto& c) {
    return std::array<decltype(&c.mu_static), 6>{&c.mu_static,           &c.mu_dynamic,
                                                 &c.transition_velocity, &c.bristle_stiffness,
                                                 &c.bristle_damping,     &c.dwell_time};
  };
  const Eigen::Vector3d u(0.004, -0.006, 0.002), zeta(0.3, 0.1, -0.2);
  auto lanes = bristle_constants<Lanes<8>>();
  for (std::size_t k = 0; k < 6; ++k) members(lanes)[k]->v[static_cast<int>(k)] = 1.0;
  const auto result = outputs<Lanes<8>>(
      lanes_law(u.cast<Lanes<8>>(), {zeta.cast<Lanes<8>>(), Lanes<8>(0.3)}, lanes));
  for (std::size_t k = 0; k < 6; ++k) {
    auto c = bristle_constants<Complex>();
    *members(c)[k] += Complex(0.0, 1e-30);
    const auto reference =
        outputs<Complex>(complex_law(u.cast<Complex>(), {zeta.cast<Complex>(), Complex(0.3)}, c));
    for (Eigen::Index row = 0; row < 7; ++row) {
      const double expected = reference[row].imag() / 1e-30;
      EXPECT_NEAR(result[row].v[static_cast<int>(k)], expected, 1e-12 * (1.0 + std::abs(expected)))
          << k << " " << row;
    }
  }
}

}  // namespace codesign
