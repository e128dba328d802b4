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

/// What happens to a motion at an instant of a period, and the time for which it flows then.
struct PeriodPiece {
  Eigen::MatrixXcd jump;  ///< x behind the instant by [x | w]; w: one input
  double time = 0.0;      ///< [s]
};

/// The course of a period: which of some pieces follow each other.
struct PeriodPieces {
  std::vector<PeriodPiece> different;
  std::vector<int> order;  ///< places in `different`
};

/// Matrices of a linearization whose imaginary parts are derivatives along one direction of the
/// design, a complex step: divided by kStep.
struct ComplexSpace {
  static constexpr double kStep = 1e-30;
  Eigen::MatrixXcd A, B, C, D;
  /// the period of a loop of one input that flows between instants, which has A, B, C, D there;
  /// empty: there is none
  PeriodPieces pieces{};
};

}  // namespace codesign
