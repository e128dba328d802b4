// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/triangular_root.h"

#include <Eigen/Householder>
#include <algorithm>

namespace codesign {
namespace {

constexpr Eigen::Index kWaiting = 32;  // rows that wait for a reflection, at least

/// Replaces the first `used` rows of A by their triangular root, in the rows above; the rows below it are left over.
/// @param workspace of the size of A's columns.
template <class Matrix>
void reduce(Eigen::Index used, Matrix* A, Eigen::VectorXd* workspace) {
  const Eigen::Index columns = A->cols();
  for (Eigen::Index k = 0; k < std::min(columns, used); ++k) {
    const Eigen::Index rows = used - k, right = columns - k - 1;
    auto column = A->col(k).segment(k, rows);
    double factor = 0.0, diagonal = 0.0;
    column.makeHouseholderInPlace(factor, diagonal);
    A->block(k, k + 1, rows, right).applyHouseholderOnTheLeft(column.tail(rows - 1), factor, workspace->data());
    column.setZero();
    column[0] = diagonal;
    if (diagonal < 0.0) A->row(k).tail(right + 1) *= -1.0;
  }
}

}  // namespace

Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& A) {
  const Eigen::Index columns = A.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::max(A.rows(), columns), columns);
  Eigen::VectorXd workspace(columns);
  rows.topRows(A.rows()) = A;
  reduce(A.rows(), &rows, &workspace);
  return rows.topRows(columns);
}

void RowRoot::start(Eigen::Index columns) {
  rows_.setZero(columns + std::max(columns, kWaiting), columns);
  workspace_.resize(columns);
  used_ = 0;
}

void RowRoot::add(const Eigen::Ref<const Eigen::VectorXd>& row) {
  if (used_ == rows_.rows()) {
    reduce(used_, &rows_, &workspace_);
    used_ = rows_.cols();
  }
  rows_.row(used_++) = row.transpose();
}

// The rows stand side by side as those of triangular_root() do, which gives the same bits.
void RowRoot::root(Eigen::MatrixXd* root) {
  const Eigen::Index columns = rows_.cols();
  reduced_.resize(rows_.size());
  Eigen::Map<Eigen::MatrixXd, Eigen::AlignedMax> rows(reduced_.data(), std::max(used_, columns), columns);
  rows.setZero();
  rows.topRows(used_) = rows_.topRows(used_);
  reduce(used_, &rows, &workspace_);
  *root = rows.topRows(columns);
}

}  // namespace codesign
