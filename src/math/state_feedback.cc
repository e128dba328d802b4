// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/state_feedback.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// The symmetric X with F^T X + X F + W = 0, by the linear equations for its entries.
MatrixXd lyapunov(const MatrixXd& F, const MatrixXd& W) {
  const Index n = F.rows();
  MatrixXd equations = MatrixXd::Zero(n * n, n * n);
  for (Index column = 0; column < n; ++column)
    for (Index row = 0; row < n; ++row)
      for (Index k = 0; k < n; ++k) {
        equations(row + n * column, k + n * column) += F(k, row);
        equations(row + n * column, row + n * k) += F(k, column);
      }
  const VectorXd right = -Eigen::Map<const VectorXd>(W.data(), n * n);
  const VectorXd entries = equations.partialPivLu().solve(right);
  const MatrixXd X = Eigen::Map<const MatrixXd>(entries.data(), n, n);
  return 0.5 * (X + X.transpose());
}

bool is_stable(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues().real().maxCoeff() < 0.0;
}

}  // namespace

std::optional<RowVectorXd> lqr_gains(const MatrixXd& A, const VectorXd& b, const MatrixXd& Q,
                                     double r) {
  constexpr int kCorrections = 5;
  const Index n = A.rows();
  MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << A, -b * b.transpose() / r, -Q, -A.transpose();
  const Eigen::EigenSolver<MatrixXd> solver(hamiltonian);
  Eigen::MatrixXcd stable(2 * n, n);
  Index found = 0;
  for (Index k = 0; k < 2 * n; ++k)
    if (solver.eigenvalues()[k].real() < 0.0 && found < n)
      stable.col(found++) = solver.eigenvectors().col(k);
  if (found < n) return std::nullopt;
  const Eigen::MatrixXcd upper = stable.topRows(n).transpose(),
                         lower = stable.bottomRows(n).transpose();
  const MatrixXd P = upper.partialPivLu().solve(lower).transpose().real();
  RowVectorXd gains = b.transpose() * P / r;
  for (int k = 0; k < kCorrections; ++k) {
    const MatrixXd closed = A - b * gains;
    if (!closed.allFinite() || !is_stable(closed)) return std::nullopt;
    gains = b.transpose() * lyapunov(closed, Q + r * gains.transpose() * gains) / r;
  }
  if (!gains.allFinite()) return std::nullopt;
  return gains;
}

std::optional<RowVectorXd> gains_of_poles(const MatrixXd& A, const VectorXd& b,
                                          const std::vector<std::complex<double>>& poles) {
  constexpr double kReached = 1e-12;  // of columns that are scaled to 1
  const Index n = A.rows();
  MatrixXd reached(n, n);
  for (Index k = 0; k < n; ++k) reached.col(k) = k == 0 ? b : VectorXd(A * reached.col(k - 1));
  const VectorXd sizes = reached.colwise().norm().transpose();
  if (!(sizes.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::FullPivLU<MatrixXd> scaled(reached * sizes.cwiseInverse().asDiagonal());
  const VectorXd pivots = scaled.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kReached * pivots.maxCoeff())) return std::nullopt;
  Eigen::MatrixXcd polynomial = Eigen::MatrixXcd::Identity(n, n);
  for (const std::complex<double>& pole : poles)
    polynomial = polynomial * (A - pole * Eigen::MatrixXcd::Identity(n, n));
  // The last row of reached^-1.
  const VectorXd last = reached.transpose().fullPivLu().solve(VectorXd(VectorXd::Unit(n, n - 1)));
  return RowVectorXd(last.transpose() * polynomial.real());
}

}  // namespace codesign
