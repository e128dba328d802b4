// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEST_EQUATIONS_EQUATIONS_FIXTURE_H_
#define MECHANISM_CODESIGN_TEST_EQUATIONS_EQUATIONS_FIXTURE_H_

#include <gtest/gtest.h>

#include <string>

#include "codegen/value_code.h"
#include "equations/equations.h"
#include "math/derivative_check.h"
#include "math/ridders.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {

/// The equations of a mechanism at a generic state, and the same equations with complex numbers for derivatives by the complex step.
class EquationsFixture {
 public:
  EquationsFixture(const std::string& urdf, const std::string& study, const ReactionSharing& sharing = {});

  /// The derivative of [G; g] by one of the state's vectors at `at`, by the complex step.
  Eigen::MatrixXd reference(VectorX<std::complex<double>> State<std::complex<double>>::*member, const VectorX<double>& at);

  /// d[G; g]/dt by extrapolated differences.
  Eigen::VectorXd time_reference();

  static Eigen::MatrixXd dense(const Sparsity& pattern, const std::vector<double>& values);

  /// Expects all derivatives at `state` to agree with the complex step, from code and from the formulas, and with each other in lanes.
  /// @param recorded whether the compiled code applies at `state`; else its branches differ from the recorded ones.
  void expect_exact_derivatives(double tolerance, bool recorded = true);

  void expect_exact_derivatives_of_real(double tolerance);

  /// Expects the derivatives that are derived from the recorded residual, in each order of elimination, to be those of the formulas. Only where
  /// the recorded branches apply at `state`.
  void expect_same_derived(double tolerance);

  /// Expects that the equations have code, and that it runs at `state` if `recorded`, else not.
  void expect_code(bool recorded);

  /// Expects the same derivatives along directions of state and design from code and from the formulas.
  void expect_same_lanes();

  /// Expects [G; g] to agree with the complex equations, which are never compiled.
  void expect_exact_residual();

  RobotDescription robot;
  CompiledSystem system;
  Equations<double> real;
  Equations<std::complex<double>> complex;
  State<double> state;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_TEST_EQUATIONS_EQUATIONS_FIXTURE_H_
