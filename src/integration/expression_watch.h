// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembly.h"
#include "description/solver_options.h"
#include "integration/one_step.h"

namespace codesign {

/// Sees what a step passes over: a load, an integrand or another expression of signals that varies
/// between the points at which the step has evaluated it, such as a pulse by the angle of a crank;
/// doc/theory.md (17e).
///
/// Each expression e is evaluated along the dense output, at kPerStudy instants per duration of the
/// study and at least kLeast per step. Its integral over the step by Simpson's rule is compared
/// with that of the polynomial through its values at the stages' instants, of which the step can
/// know. The difference is an impulse that the step has missed; its effect on the rates is judged
/// by the error test. So what lasts a thousandth of the study is seen.
class ExpressionWatch {
 public:
  explicit ExpressionWatch(const CompiledSystem& system) : system_(system) {}

  /// To be called at the beginning of a run. @param equations of the steps, with the design.
  void start(const State<double>& initial, Equations<double>* equations);
  /// The error of the last attempt that its own estimate does not see, in units of the tolerance;
  /// 0 without expressions of signals and given motions. A motion that is given is followed exactly
  /// by steps of any length, and what it needs, z, is in no error test: the dense output of z is
  /// compared with G(z) = 0 in the middle of the step.
  /// @param assembly solves for rates at points of the step.
  double error(const SolverOptions& options, OneStep<double>* step, Assembly* assembly);

 private:
  static constexpr int kPerStudy = 4096, kLeast = 8;

  void use(const RosenbrockTableau& tableau);
  /// False if the number of expressions changes on the way.
  bool evaluate(OneStep<double>* step);
  double simpson(Eigen::Index expression) const;
  double rates_error(OneStep<double>* step, Assembly* assembly);
  double largest_effect(Eigen::Index expression, double missed, const SolverOptions& options,
                        OneStep<double>* step, Assembly* assembly);

  const CompiledSystem& system_;
  bool is_active_ = false;  ///< whether there can be expressions of signals
  Eigen::Index count_ = 0;  ///< expressions of the present mode, and g
  int intervals_ = kLeast;  ///< of the last attempt; even
  const RosenbrockTableau* tableau_ = nullptr;
  std::vector<double> nodes_;  ///< different instants of the stages, in parts of the step
  Eigen::VectorXd weights_;    ///< of the quadrature at the nodes
  Eigen::MatrixXd samples_;    ///< a column per point of Simpson's rule, and room for more
  Eigen::MatrixXd at_nodes_;   ///< a column per node
  VectorX<double> values_;
  State<double> point_, solved_;
};

}  // namespace codesign
