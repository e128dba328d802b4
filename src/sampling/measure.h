// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>

#include "description/ensemble.h"

namespace codesign {

/// A measure M of several values psi_i.
struct Measured {
  double value = 0.0;  ///< M
  /// dM/dpsi_i; zero exactly where psi_i does not count, and the sum is 1
  Eigen::VectorXd by_value;
  /// kWorst: the largest value. kCvar: the value at risk, the smallest psi_i that is exceeded with
  /// a probability of at most 1 - level.
  double threshold = std::numeric_limits<double>::quiet_NaN();
};

/// The measure that `options` name, with its `level` or `factor`; doc/theory.md (24a). Sums run in
/// the order of the values, so that equal arguments give equal results. Among equal values, where
/// kWorst and kCvar have a kink, the first ones count; the result is a subgradient. With
/// kMeanPlusDeviation and all values equal, the derivative of the mean is returned, which is a
/// subgradient, too.
/// @param values psi_i, at least one, all finite
/// @param weights as many, positive, of sum 1
Measured measure(const RobustOptions& options, const Eigen::VectorXd& values,
                 const Eigen::VectorXd& weights);

/// The values that `options` compares: the weighted means of its groups, or the values themselves.
/// @param by_value if not null, the derivatives of each by all values, one per row.
Eigen::VectorXd grouped(const RobustOptions& options, const Eigen::VectorXd& values,
                        const Eigen::VectorXd& weights, Eigen::MatrixXd* by_value);

}  // namespace codesign
