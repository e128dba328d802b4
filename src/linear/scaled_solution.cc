// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/scaled_solution.h"

#include "math/dense.h"

namespace codesign {
namespace {

constexpr double kScaledRank = 1e-10;  // of rows and columns that are scaled to 1

}  // namespace

ScaledSolution::ScaledSolution(const Eigen::MatrixXd& A) {
  const auto inverse = [](double size) { return size > 0.0 ? 1.0 / size : 1.0; };
  rows_ = A.cwiseAbs().rowwise().maxCoeff().unaryExpr(inverse);
  scaled_ = rows_.asDiagonal() * A;
  columns_ = scaled_.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr(inverse);
  scaled_ = scaled_ * columns_.asDiagonal();
}

Eigen::MatrixXd ScaledSolution::solve(const Eigen::MatrixXd& b) const {
  const Eigen::MatrixXd scaled_right = rows_.asDiagonal() * b;
  return columns_.asDiagonal() * LeastNorm(scaled_, kScaledRank).solve(scaled_right);
}

Eigen::MatrixXd ScaledSolution::null_vectors() const {
  return columns_.asDiagonal() * orthogonal_complement(scaled_.transpose(), kScaledRank);
}

}  // namespace codesign
