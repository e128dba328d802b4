// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The number below which a variable of Student's t distribution lies with probability p. @param p between 0 and 1
/// @param degrees of freedom, positive; infinite, or beyond 1e8: the normal distribution
double student_quantile(double p, double degrees);

/// The factor of a standard deviation that gives an interval of probability `level` around the mean: student_quantile((1 + level) / 2).
double interval_factor(double level, double degrees);

/// The probability that a chi-squared variable exceeds x. @param x 0 or more @param degrees of freedom, positive
double chi_squared_tail(double x, double degrees);

}  // namespace codesign
