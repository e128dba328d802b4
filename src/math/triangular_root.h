// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace codesign {

/// The upper triangular R with R^T R = A^T A and a diagonal that is not negative, by Householder reflections; square, of the size of A's
/// columns. A^T A itself, whose condition number is the square of A's condition number, is not formed.
Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& A);

/// The same for a matrix whose rows arrive one after another and are too many to keep. It holds two times as many rows as columns, at least
/// 32 rows more than columns. No allocation in add().
class RowRoot {
 public:
  /// Begins anew, without rows.
  void start(Eigen::Index columns);
  /// Adds a row, given as a column vector.
  void add(const Eigen::Ref<const Eigen::VectorXd>& row);
  /// R of all rows so far; resized and filled. Allocates nothing but this result once warm.
  void root(Eigen::MatrixXd* root);
  Eigen::MatrixXd root() {
    Eigen::MatrixXd R;
    root(&R);
    return R;
  }

 private:
  Eigen::MatrixXd rows_;     ///< R of the rows before, then rows that wait
  Eigen::VectorXd reduced_;  ///< memory for the root of all rows
  Eigen::VectorXd workspace_;
  Eigen::Index used_ = 0;  ///< rows in use
};

}  // namespace codesign
