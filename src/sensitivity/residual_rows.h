// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "equations/equations.h"
#include "integration/integrator.h"
#include "math/dense.h"

namespace codesign {

/// Gathers the Jacobian of the residuals while an integration runs, doc/theory.md (22a): the rows
/// of the integrand at the points of Gauss's rule in each step, times the roots of their weights in
/// the integral, and the rows of the terminal terms at the end. Only the triangular root of all
/// rows is kept.
class ResidualRows {
 public:
  /// The derivatives of the residuals of one part of the objective by the tuned parameters at
  /// `state`: p rows, one column per term. kIntegral: `state` is a point of the dense output of the
  /// last step. kTerminal: its end.
  using Differentiate =
      std::function<void(ObjectivePart part, const State<double>& state, Eigen::MatrixXd* rows)>;

  /// @param system must outlive this.
  explicit ResidualRows(const CompiledSystem& system);

  /// Begins a run: to be called after integrator->start(). kInvalidDesign for a negative weight,
  /// which has no real root, and for a loss that is no square.
  Status start(Integrator* integrator, Differentiate differentiate);
  /// Adds the rows of the step that the integrator has just taken.
  void look();
  /// Adds the rows of the integrand at a state, times the root of `weight`.
  void look_at(const State<double>& state, double weight);
  /// R of a study that ends at `state`, the consistent state at the end of the last step. Adds the
  /// terminal rows; look() must not be called afterwards.
  void finish(const State<double>& state, Eigen::MatrixXd* root);

 private:
  Status check_squares(ObjectivePart part) const;
  void add(double weight, Eigen::MatrixXd* rows);

  const CompiledSystem& system_;
  Integrator* integrator_ = nullptr;
  Differentiate differentiate_;
  double time_ = 0.0;  ///< end of the step before [s]
  State<double> state_;
  Eigen::MatrixXd integral_rows_, terminal_rows_;
  RowRoot root_;
};

}  // namespace codesign
