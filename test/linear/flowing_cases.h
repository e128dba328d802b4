// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>

#include "linear/state_space.h"

namespace codesign {

/// A cart of 1 kg, its position controlled by a PD with a lag of 0.05 s, whose speed a sampled
/// controller damps each 0.1 s, 0.05 s late: x = (position, speed, effort, held, waiting), w beside
/// the output y of the PD. `step` along a direction of the design.
inline ComplexSpace damped_cart(std::complex<double> step = 0.0) {
  using Matrix = Eigen::MatrixXcd;
  const std::complex<double> gain = 20.0 + 3.0 * step, damping = 6.0 - step,
                             lag = 0.05 * (1.0 + 0.2 * step);
  Matrix A = Matrix::Zero(5, 5), C = Matrix::Zero(1, 5), B = Matrix::Zero(5, 1);
  C(0, 0) = -gain;
  C(0, 1) = -0.05 * gain;
  A(0, 1) = A(1, 2) = A(1, 3) = 1.0;
  A(1, 1) = -0.5 - 0.1 * step;
  A.row(2) = C / lag;
  A(2, 2) = -1.0 / lag;
  B(2, 0) = 1.0 / lag;
  Matrix sample = Matrix::Identity(5, 6), apply = sample;
  sample.row(4).setZero();
  sample(4, 1) = -damping;
  apply.row(3).setZero();
  apply(3, 4) = 1.0;
  return {A, B, C, Matrix::Zero(1, 1), {{{sample, 0.05}, {apply, 0.05}}, {0, 1}}};
}

/// The same with its derivative as imaginary parts.
inline ComplexSpace moving_cart() {
  return damped_cart(std::complex<double>(0.0, ComplexSpace::kStep));
}

}  // namespace codesign
