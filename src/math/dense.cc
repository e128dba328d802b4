// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/dense.h"

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

Eigen::Vector3d principal_moments(const Eigen::Matrix3d& J) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace codesign
