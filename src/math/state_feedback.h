// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace codesign {

/// The gains k of u = -k x that minimize the integral of x^T Q x + r u^2 along x' = A x + b u:
/// k = b^T P/r with the stabilizing solution of A^T P + P A - P b b^T P/r + Q = 0, from the stable
/// eigenvectors of its Hamiltonian matrix (Potter 1966), refined by Newton's method (Kleinman
/// 1968).
/// @param Q symmetric, not negative. @param r positive. @returns nothing if there is no such
/// solution: what b does not reach is not stable, or Q does not see what is not.
std::optional<Eigen::RowVectorXd> lqr_gains(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                            const Eigen::MatrixXd& Q, double r);

/// The gains k for which A - b k has these eigenvalues: as many as A has, conjugates in pairs
/// (Ackermann 1972). @returns nothing if b does not reach all of x.
std::optional<Eigen::RowVectorXd> gains_of_poles(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                                 const std::vector<std::complex<double>>& poles);

}  // namespace codesign
