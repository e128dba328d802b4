// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/conditional_normal.h"

#include <cmath>

namespace codesign {
namespace {

constexpr double kZeroPivot = 1e-12;  // of the variance
// Of the product of deviations: largest remainder below a pivot of zero.
constexpr double kZeroColumn = 1e-6;
constexpr double kNegativePivot = -1e-9;  // of the variance: a pivot below this is not rounding

}  // namespace

std::optional<ConditionalNormal> conditional_normal(const Eigen::MatrixXd& covariance) {
  const Eigen::Index size = covariance.rows();
  const Eigen::VectorXd variances = covariance.diagonal();
  if (size > 0 && variances.minCoeff() < 0.0) return std::nullopt;
  Eigen::MatrixXd rest = covariance, factor = Eigen::MatrixXd::Identity(size, size);
  ConditionalNormal result{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (Eigen::Index k = 0; k < size; ++k) {
    const double pivot = rest(k, k);
    if (pivot < kNegativePivot * variances[k]) return std::nullopt;
    if (pivot <= kZeroPivot * variances[k]) {
      for (Eigen::Index i = k + 1; i < size; ++i)
        if (std::abs(rest(i, k)) > kZeroColumn * std::sqrt(variances[i] * variances[k]))
          return std::nullopt;
      continue;
    }
    result.deviations[k] = std::sqrt(pivot);
    const Eigen::Index below = size - k - 1;
    factor.col(k).tail(below) = rest.col(k).tail(below) / pivot;
    rest.bottomRightCorner(below, below) -=
        pivot * factor.col(k).tail(below) * factor.col(k).tail(below).transpose();
  }
  const Eigen::MatrixXd inverse =
      factor.triangularView<Eigen::UnitLower>().solve(Eigen::MatrixXd::Identity(size, size));
  result.slopes.triangularView<Eigen::StrictlyLower>() = -inverse;
  return result;
}

}  // namespace codesign
