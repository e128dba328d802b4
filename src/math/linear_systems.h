// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

namespace codesign {

// Matrices of linear systems x' = A x + B u, y = C x + D u. As in math/dense.h the templates of
// Eigen are compiled once, in linear_systems.cc; all functions allocate.

/// Eigenvalues and right eigenvectors (columns) of a square matrix.
struct SystemEigen {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  /// Left eigenvectors l (columns), l^T A = value l^T, with l^T r = 1 for the right one r of the
  /// same place; large or not finite where eigenvalues meet in one vector.
  Eigen::MatrixXcd left;
  /// How far each eigenvalue moves when every row of the balanced matrix changes by the rounding
  /// of its largest entry: far for double ones, which a small change splits.
  Eigen::VectorXd uncertainty;
};
/// By QR after balancing: a diagonal similarity by powers of two makes row and column norms alike,
/// so that states of different units do not spoil each other.
SystemEigen system_eigen(const Eigen::MatrixXd& A);

/// exp(A), after the same balancing by Eigen: Pade's approximation with scaling and squaring
/// (Higham 2005).
Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd& A);
/// The same of numbers with derivatives as imaginary parts, a complex step.
Eigen::MatrixXcd matrix_exponential(const Eigen::MatrixXcd& A);
/// The same of complex numbers, balanced by their sizes.
Eigen::MatrixXcd complex_exponential(const Eigen::MatrixXcd& A);

/// The solutions of A x = b, one per column, by LU with partial pivoting; A b.
Eigen::MatrixXcd complex_solution(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& b);
Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

/// The eigenvalues of a complex matrix, by QR after the same balancing.
Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXcd& A);
/// An eigenvalue with its vectors, A right = value right, left^T A = value left^T, left^T right
/// = 1.
struct EigenTriple {
  std::complex<double> value;
  Eigen::VectorXcd right, left;
};
/// All of them; left ones are not finite where eigenvalues meet in one vector.
std::vector<EigenTriple> complex_eigen(const Eigen::MatrixXcd& A);

/// The largest singular value of A, with left^H A right = value.
struct LargestGain {
  double value = 0.0;
  Eigen::VectorXcd left, right;
};
LargestGain largest_gain(const Eigen::MatrixXcd& A);

/// f(A) on the invariant subspace of the eigenvalues within a circle, and zero on that of all
/// others: the integral of f(z) (z I - A)^-1 dz / (2 pi i) by the trapezoidal rule, which converges
/// as a power series does: f has no pole within. The derivative of the sum of g of these
/// eigenvalues by A is the trace of this matrix times dA, with f = g', wherever they meet (Kato
/// 1966).
/// @param points of the rule.
Eigen::MatrixXcd within_circle(const Eigen::MatrixXd& A, std::complex<double> centre, double radius,
                               int points,
                               const std::function<std::complex<double>(std::complex<double>)>& f);

/// The transfer function c (s I - A)^-1 b + d of one input and one output. A value takes n^2
/// operations, by Hessenberg's form.
class TransferFunction {
 public:
  TransferFunction(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::RowVectorXd& c,
                   double d);
  /// The value at s; not finite at a pole.
  std::complex<double> at(std::complex<double> s) const;
  double at_infinity() const { return d_; }

 private:
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
  Eigen::RowVectorXd c_;
  double d_;
};

}  // namespace codesign
