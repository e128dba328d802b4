// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/linear_systems.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Parlett and Reinsch: makes the norms of row k and column k alike, by powers of two, which round
/// nothing. @returns the diagonal of the similarity.
Eigen::VectorXd balance(MatrixXd* A) {
  constexpr int kMostSweeps = 100;
  constexpr double kGain = 0.95;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(A->rows());
  bool goes_on = true;
  for (int sweep = 0; goes_on && sweep < kMostSweeps; ++sweep) {
    goes_on = false;
    for (Index k = 0; k < A->rows(); ++k) {
      const double own = std::abs((*A)(k, k));
      const double column = A->col(k).cwiseAbs().sum() - own;
      const double row = A->row(k).cwiseAbs().sum() - own;
      if (!(column > 0.0 && row > 0.0 && std::isfinite(column + row))) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (column * factor + row / factor >= kGain * (column + row)) continue;
      goes_on = true;
      scale[k] *= factor;
      A->col(k) *= factor;
      A->row(k) /= factor;
    }
  }
  return scale;
}

/// The same matrix with entries changed as rounding changes them; always the same changes.
MatrixXd rounded(const MatrixXd& A) {
  constexpr double kOfRow = 1e-13, kOfAll = 1e-16;
  std::mt19937 generator(1);
  MatrixXd changed = A;
  const double largest = A.cwiseAbs().maxCoeff();
  for (Index row = 0; row < A.rows(); ++row) {
    const double size = kOfRow * A.row(row).cwiseAbs().maxCoeff() + kOfAll * largest;
    for (Index k = 0; k < A.cols(); ++k) changed(row, k) += generator() % 2 == 0 ? size : -size;
  }
  return changed;
}

/// Sets the left eigenvectors. Where eigenvalues meet in one vector there are none, and vectors of
/// both sides are those of the matrix as rounding changes it: the common subspace hardly moves.
void set_left(const MatrixXd& balanced, const Eigen::VectorXd& scale, Eigen::MatrixXcd vectors,
              SystemEigen* eigen) {
  constexpr double kOneVector = 1e9;  // of vectors of unit length, beyond what rounding splits
  Eigen::MatrixXcd inverse = vectors.inverse();
  if (!(inverse.norm() < kOneVector)) {
    const Eigen::EigenSolver<MatrixXd> solver(rounded(balanced));
    const Eigen::MatrixXcd all = solver.eigenvectors();
    Eigen::VectorXcd left_over = solver.eigenvalues();
    for (Index k = 0; k < vectors.cols(); ++k) {
      Index nearest = 0;
      (left_over.array() - eigen->values[k]).abs().minCoeff(&nearest);
      vectors.col(k) = all.col(nearest);
      left_over[nearest] = std::numeric_limits<double>::infinity();
    }
    inverse = vectors.inverse();
    eigen->vectors = scale.asDiagonal() * vectors;
  }
  eigen->left = scale.cwiseInverse().asDiagonal() * inverse.transpose();
}

}  // namespace

SystemEigen system_eigen(const MatrixXd& A) {
  if (A.rows() == 0) return {};
  constexpr double kSafety = 10.0;
  MatrixXd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  const Eigen::EigenSolver<MatrixXd> solver(balanced);
  SystemEigen eigen{solver.eigenvalues(), scale.asDiagonal() * solver.eigenvectors(), {}, {}};
  set_left(balanced, scale, solver.eigenvectors(), &eigen);
  const Eigen::VectorXcd moved =
      Eigen::EigenSolver<MatrixXd>(rounded(balanced), false).eigenvalues();
  eigen.uncertainty.resize(A.rows());
  for (Index k = 0; k < A.rows(); ++k)
    eigen.uncertainty[k] = kSafety * (moved.array() - eigen.values[k]).abs().minCoeff() +
                           1e-15 * std::abs(eigen.values[k]);
  return eigen;
}

MatrixXd matrix_exponential(const MatrixXd& A) {
  MatrixXd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  const MatrixXd result = balanced.exp();
  return scale.asDiagonal() * result * scale.cwiseInverse().asDiagonal();
}

Eigen::MatrixXcd matrix_exponential(const Eigen::MatrixXcd& A) {
  MatrixXd balanced = A.real();
  const Eigen::VectorXd scale = balance(&balanced);
  const Eigen::MatrixXcd similar = scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal();
  const Eigen::MatrixXcd result = similar.exp();
  return scale.asDiagonal() * result * scale.cwiseInverse().asDiagonal();
}

Eigen::MatrixXcd complex_solution(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::MatrixXcd within_circle(const MatrixXd& A, std::complex<double> centre, double radius,
                               int points,
                               const std::function<std::complex<double>(std::complex<double>)>& f) {
  constexpr double kTurn = 6.283185307179586;
  MatrixXd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  const Eigen::MatrixXcd unit = Eigen::MatrixXcd::Identity(A.rows(), A.rows());
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(A.rows(), A.rows());
  for (int k = 0; k < points; ++k) {
    const std::complex<double> from_centre = std::polar(radius, kTurn * (k + 0.5) / points),
                               z = centre + from_centre;
    sum += f(z) * from_centre / static_cast<double>(points) *
           complex_solution(z * unit - balanced, unit);
  }
  return scale.asDiagonal() * sum * scale.cwiseInverse().asDiagonal();
}

Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A * B; }

namespace {

/// A, and the diagonal of the similarity that balances it.
Eigen::VectorXd balance(Eigen::MatrixXcd* A) {
  MatrixXd sizes = A->cwiseAbs();
  Eigen::VectorXd scale = balance(&sizes);
  *A = (scale.cwiseInverse().asDiagonal() * *A * scale.asDiagonal()).eval();
  return scale;
}

}  // namespace

Eigen::MatrixXcd complex_exponential(const Eigen::MatrixXcd& A) {
  Eigen::MatrixXcd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  const Eigen::MatrixXcd result = balanced.exp();
  return scale.asDiagonal() * result * scale.cwiseInverse().asDiagonal();
}

Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXcd& A) {
  if (A.rows() == 0) return {};
  Eigen::MatrixXcd balanced = A;
  balance(&balanced);
  return Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(balanced, false).eigenvalues();
}

std::vector<EigenTriple> complex_eigen(const Eigen::MatrixXcd& A) {
  std::vector<EigenTriple> triples;
  if (A.rows() == 0) return triples;
  Eigen::MatrixXcd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(balanced);
  const Eigen::MatrixXcd inverse = solver.eigenvectors().inverse();
  for (Index k = 0; k < A.rows(); ++k)
    triples.push_back({solver.eigenvalues()[k], scale.asDiagonal() * solver.eigenvectors().col(k),
                       scale.cwiseInverse().asDiagonal() * inverse.row(k).transpose()});
  return triples;
}

LargestGain largest_gain(const Eigen::MatrixXcd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues()[0], svd.matrixU().col(0), svd.matrixV().col(0)};
}

TransferFunction::TransferFunction(const MatrixXd& A, const Eigen::VectorXd& b,
                                   const Eigen::RowVectorXd& c, double d)
    : H_(A), b_(b), c_(c), d_(d) {
  if (A.rows() == 0) return;
  MatrixXd balanced = A;
  const Eigen::VectorXd scale = balance(&balanced);
  b_ = scale.cwiseInverse().asDiagonal() * b;
  c_ = c * scale.asDiagonal();
  H_ = balanced;
  if (A.rows() < 3) return;
  const Eigen::HessenbergDecomposition<MatrixXd> hessenberg(balanced);
  const MatrixXd Q = hessenberg.matrixQ();
  H_ = hessenberg.matrixH();
  b_ = Q.transpose() * b_;
  c_ = c_ * Q;
}

// Gaussian elimination of s I - H; only neighbouring rows are exchanged.
std::complex<double> TransferFunction::at(std::complex<double> s) const {
  const Index n = H_.rows();
  if (n == 0) return d_;
  Eigen::MatrixXcd M = -H_.cast<std::complex<double>>();
  M.diagonal().array() += s;
  Eigen::VectorXcd x = b_.cast<std::complex<double>>();
  for (Index k = 0; k + 1 < n; ++k) {
    if (std::abs(M(k + 1, k)) > std::abs(M(k, k))) {
      M.row(k).tail(n - k).swap(M.row(k + 1).tail(n - k));
      std::swap(x[k], x[k + 1]);
    }
    if (M(k + 1, k) == 0.0) continue;
    const std::complex<double> factor = M(k + 1, k) / M(k, k);
    for (Index column = k; column < n; ++column) M(k + 1, column) -= factor * M(k, column);
    x[k + 1] -= factor * x[k];
  }
  std::complex<double> result = d_;
  for (Index k = n - 1; k >= 0; --k) {
    for (Index column = k + 1; column < n; ++column) x[k] -= M(k, column) * x[column];
    x[k] /= M(k, k);
    result += c_[k] * x[k];
  }
  return result;
}

}  // namespace codesign
