// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_
#define MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanism_codesign/status.h"
#include "statistics/long_run.h"

namespace codesign {

/// Residuals of a fit and their derivatives, whatever they compare.
class ResidualSource {
 public:
  virtual ~ResidualSource() = default;
  /// Names of the columns of the residuals.
  virtual const std::vector<std::string>& outputs() const = 0;
  /// Residuals of each recording; their sum is the number of rows.
  virtual const SeriesLengths& lengths() const = 0;
  /// @param residuals resized to rows x outputs. @param jacobian may be null; else resized to (rows outputs) x size of x, the rows of
  /// output 0 first. @return a failure at this point, kCancelled, or ok
  virtual Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals, Eigen::MatrixXd* jacobian) = 0;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_IDENTIFICATION_RESIDUAL_SOURCE_H_
