// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "description/identification.h"
#include "statistics/identifiability.h"
#include "statistics/time_series.h"

namespace codesign {

/// How well the p parameters of a least-squares fit are known, to first order; doc/theory.md
/// (33)-(36).
struct ParameterCovariance {
  Identifiability identifiability;
  /// p x p. A parameter that the data do not determine has an infinite variance, and its
  /// covariances are NaN.
  Eigen::MatrixXd covariance;
  /// the interval at the level is [x - below, x + above]; infinite where the data do not determine
  /// x
  Eigen::VectorXd below, above;
  /// Deviation of combination_of() each parameter with the dependent ones, and its interval; of a
  /// determined parameter its own. Zero for the dependent parameters.
  Eigen::VectorXd combination_deviation, combination_below, combination_above;
  /// sum of squares divided by (rows - rank), in squared units of the residuals
  double residual_variance = 0.0;
  Eigen::VectorXd degrees;  ///< of freedom of Student's t in the interval of each parameter
  int lag = 0;  ///< lag of the kernel, or number of neighbours in a block; 0 for white noise

  /// p x p, ones on the diagonal; NaN where the covariance is NaN.
  Eigen::MatrixXd correlation() const;
};

/// Unknowns that were fitted beside the parameters, and whose columns were projected out of the
/// Jacobian, doc/theory.md (43); they take degrees of freedom.
struct EliminatedUnknowns {
  Eigen::Index count = 0;
  /// rows of each piece with unknowns of its own; a piece lies within one recording. Empty without
  /// such unknowns
  SeriesLengths pieces = {};
  /// N x m: zero of residuals that do not count in their variance, else one; empty: all count
  Eigen::MatrixXd counted = {};
};

/// @param residuals at the fit, one row per time and one column per output (joint), N x m; several
/// recordings stand below each other
/// @param jacobian of the residuals, N m x p: the rows of output 0 in the order of time, then those
/// of output 1, and so on. With a robust loss both are multiplied by the square roots of the
/// weights.
/// @param lengths of the recordings, with the sum N. Outputs at one time may depend on each other,
/// recordings do not.
/// @param options level, noise and lag
ParameterCovariance parameter_covariance(const Eigen::MatrixXd& residuals,
                                         const Eigen::MatrixXd& jacobian,
                                         const SeriesLengths& lengths,
                                         const IntervalOptions& options,
                                         const EliminatedUnknowns& eliminated = {});

/// The covariance that a fit is expected to have, before there are data: parameter_covariance() for
/// residuals that are white noise of variance one.
/// @param jacobian of the residuals, each divided by its standard deviation, or a factor R of it
/// with R^T R = J^T J
/// @param rows of the jacobian. @param level of the intervals
ParameterCovariance predicted_covariance(const Eigen::MatrixXd& jacobian, Eigen::Index rows,
                                         double level);

/// The number below which a variable of Student's t distribution lies with probability p. @param p
/// between 0 and 1
/// @param degrees of freedom, positive; infinite, or beyond 1e8: the normal distribution
double student_quantile(double p, double degrees);

/// The factor of a standard deviation that gives an interval of probability `level` around the
/// mean: student_quantile((1 + level) / 2).
double interval_factor(double level, double degrees);

/// The probability that a chi-squared variable exceeds x. @param x 0 or more @param degrees of
/// freedom, positive
double chi_squared_tail(double x, double degrees);

}  // namespace codesign
