// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/iteration_matrix.h"
#include "integration/idas_handles.h"

namespace codesign {

class CompiledSystem;

/// The linear solver of IDAS's Newton iteration, J x = b with J = F_y + c_j F_y', as a
/// SUNLinearSolver with a SUNMatrix; doc/theory.md (26).
///
/// With y = (q, v, s, lambda) and F = (q' - v, G), the rows q' - v and the columns of q are
/// eliminated:
///   (G_z + G_v/c_j + G_q/c_j^2) (u_a, u_lambda, u_sigma) = b_G - G_q b_q/c_j,
///   x_v = u_a/c_j,  x_q = (x_v + b_q)/c_j,  x_s = u_sigma/c_j,  x_lambda = u_lambda.
/// A stabilized constraint row is divided by (1 + kappa/c_j)^2, so that it keeps Phi_q in the
/// columns of a, (26a).
class IdasNewton {
 public:
  IdasNewton(const CompiledSystem& system, SUNContext context);

  /// Derivatives for the next setup, which forms and factors the reduced matrix; set by the
  /// Jacobian callback.
  Linearization<double>* derivatives() { return &derivatives_; }
  /// @param c_j of IDAS: derivative of y' by y [1/s]. @param kappa rate of stabilization [1/s].
  void set_rates(double c_j, double kappa) {
    c_j_ = c_j;
    kappa_ = kappa;
  }

  /// Factors the matrix at other derivatives, with the rates of the last set_rates(). False if it
  /// is singular.
  bool refactor(const Linearization<double>& derivatives);

  /// The correction [delta; multipliers; 0] (Layout::columns() entries) that removes a constraint
  /// error (m entries) as in (17), with the matrix of the last setup in place of G_z.
  void correct(const VectorX<double>& error, VectorX<double>* correction) const;

  /// IterationMatrix::reset_pivots(), at the beginning of a run.
  void reset_pivots() { reduced_.reset_pivots(); }
  /// IterationMatrix::keep_pivots_of().
  void keep_pivots_of(const IterationMatrix& other) { reduced_.keep_pivots_of(other); }

  SUNMatrix matrix() { return matrix_.get(); }
  SUNLinearSolver solver() { return solver_.get(); }
  /// Whether the matrix of the last setup was singular.
  bool singular() const { return singular_; }

 private:
  bool factor();
  void stabilize();
  void subtract_stabilization(In<double> b_q);
  static int setup(SUNLinearSolver solver, SUNMatrix matrix);
  static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b,
                   sunrealtype tolerance);
  void solve(In<double> b, Out<double> x);

  const CompiledSystem& system_;
  IterationMatrix reduced_;
  Linearization<double> derivatives_;
  VectorX<double> u_;
  double c_j_ = 1.0, kappa_ = 0.0;  ///< [1/s]
  bool singular_ = false;
  MatrixHandle matrix_;
  LinearSolverHandle solver_;
};

}  // namespace codesign
