// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace codesign {

/// Solutions of least norm, A x = b, after scaling rows and columns to the largest entry 1, since
/// coordinates, reactions and integrals have units of their own; and what A does not determine.
class ScaledSolution {
 public:
  explicit ScaledSolution(const Eigen::MatrixXd& A);

  /// @param b one right-hand side per column.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// A basis, one vector per column, of the x with A x = 0.
  Eigen::MatrixXd null_vectors() const;

 private:
  Eigen::MatrixXd scaled_;
  Eigen::VectorXd rows_, columns_;
};

}  // namespace codesign
