// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/relative_inertia.h"

#include <array>
#include <cmath>

#include "identification/fit/inertial_numbers.h"

namespace codesign {
namespace {

constexpr std::array<int, 10> kRow{0, 1, 2, 3, 0, 0, 0, 1, 1, 2},
    kColumn{0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
const double kRootTwo = std::sqrt(2.0);

/// U^-1 B of an upper triangular U.
Eigen::Matrix4d solve_upper(const Eigen::Matrix4d& U, Eigen::Matrix4d B) {
  for (int column = 0; column < 4; ++column)
    for (int row = 3; row >= 0; --row) {
      for (int k = row + 1; k < 4; ++k) B(row, column) -= U(row, k) * B(k, column);
      B(row, column) /= U(row, row);
    }
  return B;
}

/// The upper triangular V with a positive diagonal and V V^T = E.
Eigen::Matrix4d upper_root(const Eigen::Matrix4d& E) {
  Eigen::Matrix4d V = Eigen::Matrix4d::Zero();
  for (int j = 3; j >= 0; --j)
    for (int i = j; i >= 0; --i) {
      double left = E(i, j);
      for (int k = j + 1; k < 4; ++k) left -= V(i, k) * V(j, k);
      V(i, j) = i == j ? std::sqrt(left) : left / V(j, j);
    }
  return V;
}

/// The change of the ten numbers with U, to first order. @param x the numbers of U
RelativeInertia::Ten change_of_numbers(const RelativeInertia::Ten& x, const Eigen::Matrix4d& dU) {
  const double mass_root = std::exp(x[0]), relative = dU(3, 3) / mass_root;
  RelativeInertia::Ten dx;
  dx << relative, dU(0, 0) / std::exp(x[0] + x[1]) - relative,
      dU(1, 1) / std::exp(x[0] + x[2]) - relative, dU(2, 2) / std::exp(x[0] + x[3]) - relative,
      dU(0, 1) / mass_root, dU(1, 2) / mass_root, dU(0, 2) / mass_root, dU(0, 3) / mass_root,
      dU(1, 3) / mass_root, dU(2, 3) / mass_root;
  dx.tail<6>() -= relative * x.tail<6>();
  return dx;
}

}  // namespace

Eigen::Matrix4d symmetric_matrix(const SymmetricNumbers& e) {
  Eigen::Matrix4d E;
  for (std::size_t k = 0; k < kRow.size(); ++k) {
    const double entry = e[static_cast<Eigen::Index>(k)] / (kRow[k] == kColumn[k] ? 1.0 : kRootTwo);
    E(kRow[k], kColumn[k]) = E(kColumn[k], kRow[k]) = entry;
  }
  return E;
}

SymmetricNumbers symmetric_numbers(const Eigen::Matrix4d& E) {
  SymmetricNumbers e;
  for (std::size_t k = 0; k < kRow.size(); ++k)
    e[static_cast<Eigen::Index>(k)] =
        E(kRow[k], kColumn[k]) * (kRow[k] == kColumn[k] ? 1.0 : kRootTwo);
  return e;
}

RelativeInertia::RelativeInertia(const Ten& known) : known_(cholesky_factor(known)) {}

Eigen::Matrix4d RelativeInertia::factor(const Ten& x) const {
  return solve_upper(known_, cholesky_factor(x));
}

Eigen::Matrix4d RelativeInertia::matrix(const Ten& x) const {
  const Eigen::Matrix4d V = factor(x);
  return V * V.transpose();
}

Eigen::Matrix4d RelativeInertia::factor_slope(const Ten& x, int k) const {
  return solve_upper(known_, cholesky_slope(x, k));
}

// From dE = dV V^T + V dV^T: V^-1 dV is the upper half of V^-1 dE V^-T.
Eigen::Matrix<double, 10, 10> RelativeInertia::numbers_by_matrix(const Ten& x) const {
  const Eigen::Matrix4d V = factor(x), inverse = solve_upper(V, Eigen::Matrix4d::Identity());
  Eigen::Matrix<double, 10, 10> slopes;
  for (int k = 0; k < 10; ++k) {
    Eigen::Matrix4d half =
        inverse * symmetric_matrix(SymmetricNumbers::Unit(k)) * inverse.transpose();
    half.diagonal() *= 0.5;
    for (int row = 1; row < 4; ++row) half.row(row).head(row).setZero();
    slopes.col(k) = change_of_numbers(x, known_ * (V * half));
  }
  return slopes;
}

RelativeInertia::Ten RelativeInertia::numbers(const Eigen::Matrix4d& E) const {
  const Eigen::Matrix4d U = known_ * upper_root(E);
  const double m = U(3, 3);
  Ten x;
  x << std::log(m), std::log(U(0, 0) / m), std::log(U(1, 1) / m), std::log(U(2, 2) / m),
      U(0, 1) / m, U(1, 2) / m, U(0, 2) / m, U(0, 3) / m, U(1, 3) / m, U(2, 3) / m;
  return x;
}

}  // namespace codesign
