// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/triangular_root.h"

#include <Eigen/QR>
#include <algorithm>

namespace codesign {
namespace {

constexpr Eigen::Index kWaiting = 32;  // rows that wait for a reflection, at least

}  // namespace

Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& A) {
  const Eigen::Index columns = A.cols();
  if (columns == 0) return {};
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(std::max(A.rows(), columns), columns);
  padded.topRows(A.rows()) = A;
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> factors(padded);
  Eigen::MatrixXd R = padded.topRows(columns).triangularView<Eigen::Upper>();
  for (Eigen::Index k = 0; k < columns; ++k)
    if (R(k, k) < 0.0) R.row(k) = -R.row(k);
  return R;
}

void RowRoot::start(Eigen::Index columns) {
  rows_.setZero(columns + std::max(columns, kWaiting), columns);
  used_ = 0;
}

void RowRoot::add(const Eigen::Ref<const Eigen::VectorXd>& row) {
  if (used_ == rows_.rows()) {
    const Eigen::MatrixXd R = triangular_root(rows_);
    rows_.topRows(R.rows()) = R;
    used_ = R.rows();
  }
  rows_.row(used_++) = row.transpose();
}

Eigen::MatrixXd RowRoot::root() const { return triangular_root(rows_.topRows(used_)); }

}  // namespace codesign
