// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <string>
#include <vector>

#include "ensemble/parameter_rows.h"
#include "ensemble/scenario.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/scaling.h"
#include "optimization/smooth_program.h"

namespace codesign {

/// Writes the derivatives of a number by the optimizer's variables: the scaled parameters, then the
/// slack variables.
void spread(const SmoothProgram::Value& value, const Scaling& scaling, double* by_x);

/// The optimality conditions of a design in the smooth form of the problem, doc/theory.md (24j).
struct Optimality {
  double slope = 0.0;  ///< residual of the conditions, in the unit of psi; 0 at an optimum
  /// multipliers of the bounds of the scaled parameters: positive at the lower one, negative at the
  /// upper one
  Eigen::VectorXd bounds;
  /// gradients by the scaled parameters of the rows with a multiplier and of all equalities, one
  /// per column
  Eigen::MatrixXd active;
  int factorizations = 0;  ///< of matrices of the variables, as a measure of the work
};

/// With the multipliers, of the sign that their rows require, which make the residual least. @param
/// at the evaluation of the design.
/// @param cancel ends the search for these multipliers, after which the slope is too large; may be
/// null.
Optimality optimality(const EnsembleEvaluation& at, const Eigen::VectorXd& rho,
                      const Scaling& scaling, const ParameterRows& parameters,
                      SmoothProgram* program, const std::atomic<bool>* cancel = nullptr);

/// The violation of a bound on a signal that a search aims at, in the unit of the signal: smaller
/// ones do not make a point worse.
constexpr double kMostViolation = 1e-8;
/// The violation at which a bound counts as met at the end of a search, where the study gives no
/// `tolerance`: this share of the largest magnitude of the signal at the end of the search and of
/// its bounds; at least kMostViolation.
constexpr double kShareOfRange = 1e-5;

/// The default of WatchedResult::tolerance, from the values at the instants at which the signal is
/// watched.
double tolerance_of_range(const WatchedResult& watched);

/// Widens the default tolerances of `final`: it watches one instant, at which a signal that has to
/// end at zero tells nothing of its range, so that the magnitude of the signal in a whole run of
/// the scenario counts, too.
/// @param cancel if set, the run ends early, and the range is that of the run so far.
void count_range_of_run(const Scenario& scenario, const Eigen::VectorXd& rho,
                        const std::atomic<bool>* cancel, std::vector<WatchedResult>* watched);

/// Whether the best point of a search meets all constraints, on parameters and on signals.
bool meets_constraints(const Study& study, const OptimizationResult& result);

/// A sentence that lists the violated bounds of signals, for the status.
std::string describe_violated(const std::vector<WatchedResult>& watched);

}  // namespace codesign
