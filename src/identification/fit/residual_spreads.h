// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "description/identification.h"

namespace codesign {

/// The root mean square of each output's residuals. @param counted ResidualSource::counted()
Eigen::VectorXd rms_of(const Eigen::MatrixXd& residuals, const Eigen::MatrixXd& counted);

/// The spread of each output's residuals: their root mean square; with a robust loss 1.4826 times
/// the median of their magnitudes. @param counted ResidualSource::counted()
Eigen::VectorXd spreads_of(const Eigen::MatrixXd& residuals, const LossOptions& loss,
                           const Eigen::MatrixXd& counted = {});

/// The geometric mean over the outputs of the spreads of their residuals. It ranks fits from
/// several starts; doc/theory.md (39a).
double mean_spread(const Eigen::MatrixXd& residuals, const LossOptions& loss,
                   const Eigen::MatrixXd& counted = {});

}  // namespace codesign
