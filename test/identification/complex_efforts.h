// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <complex>
#include <optional>
#include <vector>

#include "assembly/driven_motion.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

/// The efforts of a driven mechanism by Newton's method in complex numbers with dense matrices,
/// which shares nothing with the tangents that it checks but the formulas.
class ComplexEfforts {
 public:
  using Complex = std::complex<double>;

  ComplexEfforts(const DrivenSystem& driven, DriveMotion given, const State<double>& near);

  /// @param rho the tuned parameters, then, if there are more numbers, the numbers to be added to
  /// the position of each drive.
  Eigen::VectorXcd operator()(const Eigen::VectorXcd& rho_and_shifts);

 private:
  Eigen::VectorXcd solve(const Eigen::VectorXcd& right);

  void correct(In<double> given, bool positions);

  void correct_rates();

  const CompiledSystem& system_;
  const int drives_;
  const DriveMotion given_;
  const State<double>& near_;
  Eigen::VectorXcd shifts_;
  Equations<Complex> equations_;
  State<Complex> state_;
  Linearization<Complex> derivatives_;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> lu_;
};

}  // namespace codesign
