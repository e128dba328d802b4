// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace codesign {

/// A normal distribution of several numbers, one after the other: given the numbers before it,
/// number i has the mean m_i + sum_{j<i} slopes(i, j) (x_j - m_j) and the standard deviation
/// deviations[i]; doc/theory.md (24h).
struct ConditionalNormal {
  Eigen::MatrixXd slopes;  ///< d x d, zero on the diagonal and above
  /// zero if the numbers before it determine the number, or the variance is zero
  Eigen::VectorXd deviations;
};

/// From the covariance, by its factors L D L^T. A pivot below 1e-12 of its variance counts as zero.
/// @param covariance d x d, symmetric, finite. @return std::nullopt if it is not positive
/// semidefinite
std::optional<ConditionalNormal> conditional_normal(const Eigen::MatrixXd& covariance);

}  // namespace codesign
