// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/residual_spreads.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/arrays.h"

namespace codesign {
namespace {

double median_magnitude(const Eigen::MatrixXd& residuals, Eigen::Index output,
                        const Eigen::MatrixXd& counted) {
  std::vector<double> numbers;
  for (Eigen::Index k = 0; k < residuals.rows(); ++k)
    if (counted.size() == 0 || counted(k, output) != 0.0)
      numbers.push_back(std::abs(residuals(k, output)));
  const auto middle = numbers.begin() + to_signed(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace

Eigen::VectorXd rms_of(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd& counted) {
  if (counted.size() == 0)
    return (residuals.colwise().squaredNorm() / static_cast<double>(residuals.rows()))
        .cwiseSqrt()
        .transpose();
  return residuals.cwiseProduct(counted)
      .colwise()
      .squaredNorm()
      .cwiseQuotient(counted.colwise().sum())
      .cwiseSqrt()
      .transpose();
}

Eigen::VectorXd spreads_of(const Eigen::MatrixXd& residuals, const LossOptions& loss,
                           const Eigen::MatrixXd& counted) {
  // Standard deviation over median magnitude of a normal variable.
  constexpr double kNormalMedian = 1.4826;
  if (loss.kind == LossKind::kSquare) return rms_of(residuals, counted);
  Eigen::VectorXd spreads(residuals.cols());
  for (Eigen::Index k = 0; k < spreads.size(); ++k)
    spreads[k] = kNormalMedian * median_magnitude(residuals, k, counted);
  return spreads;
}

double mean_spread(const Eigen::MatrixXd& residuals, const LossOptions& loss,
                   const Eigen::MatrixXd& counted) {
  return std::exp(spreads_of(residuals, loss, counted).array().log().mean());
}

}  // namespace codesign
