// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/loop_jacobian.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "sparse/least_squares.h"

namespace codesign {

struct TreeLoops;

/// The rows of loops and couplings that a solution heeds: all, or those that the system enforces.
/// Rows that are redundant but for rounded numbers are dropped, doc/theory.md (23b).
enum class LoopRows { kAll, kEnforced };

/// The Jacobian of the loops at one position, scaled as LoopScales says.
struct ScaledLoops {
  SparseMatrix matrix;    ///< loops.jacobian.rows() x tree.size; rows that are not heeded are zero
  SparseMatrix unscaled;  ///< with all rows
  LoopScales scales;      ///< zero for rows that are not heeded
  LoopWorkspace workspace;

  /// @param theta tree coordinates [rad or m].
  void evaluate(const TreeLoops& loops, const StartDesign& design, const VectorX<double>& theta,
                LoopRows heeded);
};

/// Some coordinates, with the least-squares solution of the scaled loops for their changes.
struct DependentSolution {
  std::vector<int> columns;  ///< the coordinates
  LeastSquares inverse;      ///< factorization of their columns of the scaled Jacobian
  LoopScales scales;

  /// @param rank_tolerance relative, for the scaled Jacobian.
  void factor(const ScaledLoops& loops, const std::vector<int>& coordinates, double rank_tolerance);
  /// Least-squares changes of the coordinates for given (unscaled) changes of the loops' rows, one
  /// column per case. @param scaled, workspace overwritten; the result is in the workspace.
  const Eigen::MatrixXd& solve(const Eigen::MatrixXd& rows, Eigen::MatrixXd* scaled,
                               LeastSquaresWorkspace* workspace) const;
};

/// What a solution for the position of the loops changes and heeds.
struct LoopSearch {
  const std::vector<int>& free;  ///< the coordinates that it changes
  double rank_tolerance;         ///< as for DependentSolution::factor()
  LoopRows heeded;
};

/// The step of Newton's method (19) at one position, and the memory that it is found in.
struct LoopStep {
  ScaledLoops loops;
  DependentSolution dependent;
  Eigen::MatrixXd scaled;
  LeastSquaresWorkspace solution;

  /// @param theta tree coordinates [rad or m]. @param errors of the rows there, LoopErrors::rows.
  /// @returns the change of the free coordinates, to be subtracted; valid until the next call.
  const Eigen::MatrixXd& find(const TreeLoops& all, const StartDesign& design,
                              const LoopSearch& search, const VectorX<double>& theta,
                              const Eigen::MatrixXd& errors);
};

}  // namespace codesign
