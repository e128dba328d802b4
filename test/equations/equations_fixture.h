// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "codegen/value_code.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "math/differences.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// The equations of a mechanism at a generic state, and the recorded values with complex numbers
/// for derivatives by the complex step, which share nothing with the derived ones.
class EquationsFixture {
 public:
  EquationsFixture(const std::string& urdf, const std::string& study,
                   const ReactionSharing& sharing = {});

  /// The derivative of [G; g] by one of the state's vectors at `at`, by the complex step.
  Eigen::MatrixXd reference(VectorX<std::complex<double>> State<std::complex<double>>::*member,
                            const VectorX<double>& at);

  /// d[G; g]/dt by extrapolated differences.
  Eigen::VectorXd time_reference();

  static Eigen::MatrixXd dense(const Sparsity& pattern, const std::vector<double>& values);

  /// Expects all derivatives at `state`, and those along directions, to agree with the complex
  /// step; the same numbers with and without machine code.
  void expect_exact_derivatives(double tolerance);
  void expect_exact_derivatives_of_real(double tolerance);

  /// Expects the same bits with and without machine code.
  void expect_same_bits();
  /// Expects the directional derivatives of [G; g] to be those of the complex step.
  void expect_exact_lanes();

  /// Expects [G; g] to agree with the formulas.
  void expect_exact_residual();

  RobotDescription robot;
  CompiledSystem system;
  Equations<double> real;
  Equations<std::complex<double>> complex;
  State<double> state;
};

}  // namespace codesign
