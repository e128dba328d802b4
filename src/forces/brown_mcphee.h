// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// Friction coefficient of Brown and McPhee (2016) without the viscous term, the bracket in the paper's (1); doc/theory.md (10):
///   S(v) = mu_d tanh(4 v / v_t) + (mu_s - mu_d) (v / v_t) / ((v / (2 v_t))^2 + 3/4)^2.
/// @param v sliding velocity with sign [m/s]. @param v_t transition velocity, > 0 [m/s].
template <class T>
T brown_mcphee(const T& v, const T& mu_static, const T& mu_dynamic, const T& v_t) {
  using std::tanh;
  const T u = v / v_t;
  const T d = 0.25 * u * u + 0.75;
  return mu_dynamic * tanh(4.0 * u) + (mu_static - mu_dynamic) / (d * d) * u;
}

}  // namespace codesign
