// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace codesign {

/// Coordinates of a symmetric matrix of order 4: the diagonal, then the entries above it, row by
/// row, times the square root of 2, so that their norm is Frobenius' norm of the matrix.
using SymmetricNumbers = Eigen::Matrix<double, 10, 1>;
Eigen::Matrix4d symmetric_matrix(const SymmetricNumbers& e);
SymmetricNumbers symmetric_numbers(const Eigen::Matrix4d& E);

/// The pseudo-inertia P = U U^T of a link, doc/theory.md (28e), relative to a known one, P0 = U0
/// U0^T:
///   E = U0^-1 P U0^-T = V V^T,   V = U0^-1 U,
/// with the mass over the known mass in E_44, the shift of the centre in known radii of gyration in
/// E_i4, second moments over the known ones in E_ij. It is the identity at P0, positive definite
/// for possible inertias, and efforts are linear in it. [-]
class RelativeInertia {
 public:
  using Ten = Eigen::Matrix<double, 10, 1>;  ///< in the order of kLogCholeskyNames

  explicit RelativeInertia(const Ten& known);

  Eigen::Matrix4d factor(const Ten& x) const;                           ///< V, upper triangular
  Eigen::Matrix4d matrix(const Ten& x) const;                           ///< E
  Eigen::Matrix4d factor_slope(const Ten& x, int k) const;              ///< dV / dx_k
  Eigen::Matrix<double, 10, 10> numbers_by_matrix(const Ten& x) const;  ///< dx / de
  /// The ten numbers x of a matrix E. @param E positive definite
  Ten numbers(const Eigen::Matrix4d& E) const;

 private:
  Eigen::Matrix4d known_;  ///< U0
};

}  // namespace codesign
