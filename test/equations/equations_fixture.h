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

/// The equations of a mechanism at a generic state, with a complex twin that differentiates them.
class EquationsFixture {
 public:
  EquationsFixture(const std::string& urdf, const std::string& study, const ReactionSharing& sharing = {});

  /// [G; g] as a function of one of the state's vectors.
  Eigen::MatrixXd reference(VectorX<std::complex<double>> State<std::complex<double>>::*member, const VectorX<double>& at);

  /// d[G; g]/dt by extrapolated differences.
  Eigen::VectorXd time_reference();

  static Eigen::MatrixXd dense(const Sparsity& pattern, const std::vector<double>& values);

  /// All derivatives at `state` against the complex step, as compiled and without; those of lanes one against the other.
  /// @param recorded whether the state's branches are those that are recorded.
  void expect_exact_derivatives(double tolerance, bool recorded = true);

  void expect_exact_derivatives_of_real(double tolerance);

  /// That there is code, and that it is used at `state`.
  void expect_code(bool recorded);

  /// Derivatives along some directions of state and design, from code and from the formulas.
  void expect_same_lanes();

  /// [G; g] as the complex twin has it, which is never compiled.
  void expect_exact_residual();

  RobotDescription robot;
  CompiledSystem system;
  Equations<double> real;
  Equations<std::complex<double>> complex;
  State<double> state;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_TEST_EQUATIONS_EQUATIONS_FIXTURE_H_
