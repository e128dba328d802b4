// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace codesign {

/// Small changes about a state, theory (67): x' = A x + B u, y = C x + D u, or from one period to
/// the next x(k+1) = A x(k) + B u(k), with u constant over each period.
struct StateSpace {
  double period = 0.0;  ///< [s]; 0: continuous
  /// joint coordinates, their rates, then states of controllers and friction
  std::vector<std::string> states;
  std::vector<std::string> inputs, outputs;
  Eigen::MatrixXd A, B, C, D;
};

}  // namespace codesign
