// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace codesign {
namespace {

using Qr = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

Qr factor(const Eigen::MatrixXd& A, double threshold) {
  Qr qr;
  qr.setThreshold(threshold);
  qr.compute(A);
  return qr;
}

unsigned options(SingularVectors vectors) {
  unsigned flags = 0;
  if (vectors == SingularVectors::kLeft || vectors == SingularVectors::kBoth) flags |= Eigen::ComputeFullU;
  if (vectors == SingularVectors::kRight || vectors == SingularVectors::kBoth) flags |= Eigen::ComputeFullV;
  return flags;
}

}  // namespace

SingularValues singular_values(const Eigen::MatrixXd& A, SingularVectors vectors) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, options(vectors));
  SingularValues result;
  result.values = svd.singularValues();
  if (svd.computeU()) result.U = svd.matrixU();
  if (svd.computeV()) result.V = svd.matrixV();
  return result;
}

PivotedColumns pivot_columns(const Eigen::MatrixXd& A, double threshold) {
  const Qr qr = factor(A, threshold);
  const auto& indices = qr.colsPermutation().indices();
  return {qr.rank(), std::vector<int>(indices.data(), indices.data() + indices.size()), qr.matrixQR().diagonal().cwiseAbs()};
}

struct PivotedLeastSquares::Implementation {
  Qr qr;
};

PivotedLeastSquares::PivotedLeastSquares(const Eigen::MatrixXd& A) : implementation_(std::make_unique<Implementation>()) {
  implementation_->qr.compute(A);
}
PivotedLeastSquares::~PivotedLeastSquares() = default;
PivotedLeastSquares::PivotedLeastSquares(PivotedLeastSquares&&) noexcept = default;

Eigen::MatrixXd PivotedLeastSquares::solve(const Eigen::MatrixXd& b) const { return implementation_->qr.solve(b); }

double PivotedLeastSquares::explained(const Eigen::VectorXd& b) const {
  const Qr& qr = implementation_->qr;
  return (qr.householderQ().transpose() * b).head(qr.rank()).squaredNorm();
}

bool is_positive_definite(const Eigen::MatrixXd& A) { return A.llt().info() == Eigen::Success; }

Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.llt().solve(b); }

Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& A) {
  const Eigen::Index rows = std::min(A.rows(), A.cols());
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(A.cols(), A.cols());
  if (rows == 0) return R;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  R.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  for (Eigen::Index k = 0; k < rows; ++k)
    if (R(k, k) < 0.0) R.row(k) *= -1.0;
  return R;
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& A, double threshold) {
  // Eigen's decomposition reads the first entry of a matrix that has none.
  if (A.cols() == 0) return Eigen::MatrixXd::Identity(A.rows(), A.rows());
  PivotedQr qr;
  qr.matrix(A.rows(), A.cols()) = A;
  qr.factor(threshold);
  Eigen::MatrixXd basis;
  qr.complement(&basis);
  return basis;
}

LeastNorm least_norm(const Eigen::MatrixXd& A) { return {A, least_norm_threshold(A.rows(), A.cols())}; }

double least_norm_threshold(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::NumTraits<double>::epsilon() * static_cast<double>(std::min(rows, columns));
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.transpose() * B; }

Eigen::Vector3d principal_moments(const Eigen::Matrix3d& J) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace codesign
