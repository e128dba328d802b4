// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "statistics/long_run.h"

namespace codesign {

/// The test of Ljung and Box whether residuals are white; doc/theory.md (37).
struct Whiteness {
  double statistic = 0.0;    ///< n (n + 2) sum_k rho_k^2 / (n - k), k = 1 ... lags
  double probability = 1.0;  ///< probability of a statistic as large or larger if the residuals are white
  int lags = 0;
  double first_correlation = 0.0;  ///< rho_1
};

/// @param residuals one output of several recordings below each other, whose means are taken off. @param lags 0: a fifth of the samples, at
/// most 10
Whiteness ljung_box(const Eigen::VectorXd& residuals, const SeriesLengths& lengths, int lags = 0);

}  // namespace codesign
