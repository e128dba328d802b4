// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "benchmark/report.h"
#include "problem/load_problem.h"

namespace codesign {

/// Reference values of the objective and its gradient.
struct ReferenceValues {
  double psi;
  Eigen::VectorXd gradient;
};

/// The accuracy and the steps of one run of a solver.
struct Outcome {
  /// Relative error of psi, or the largest relative error of a component of the gradient; NaN if
  /// the run failed.
  double error = std::numeric_limits<double>::quiet_NaN();
  long steps = 0;
};

/// The outcome of a run that gave `psi` and `gradient`. @param with_gradient whether the error is
/// that of the gradient.
Outcome outcome_of(const ReferenceValues& reference, bool with_gradient, double psi,
                   const Eigen::VectorXd& gradient, long steps);

/// A solver in a comparison. prepare() sets it up for a tolerance, with or without the gradient,
/// and returns a function that runs it once.
struct Contestant {
  std::string name;
  std::function<std::function<Outcome()>(double tolerance, bool with_gradient)> prepare;
};

/// A solver of this library. @param name as with_solver() takes it.
Contestant own_solver(const Problem& problem, const std::string& name,
                      const ReferenceValues& reference);

/// One point of a sweep over tolerances.
struct Measured {
  double tolerance;
  Outcome outcome;
  double seconds;  ///< CPU, median
};
using Sweep = std::vector<Measured>;

/// The processor time at which a solver reaches an accuracy [s]: the time at the loosest tolerance
/// such that this and all tighter ones have an error of at most `error`. NaN if there is none.
double seconds_to(double error, const Sweep& sweep);

/// What a solver needs for an error, interpolated between two tolerances along straight lines
/// between logarithms.
struct AtError {
  double seconds = std::numeric_limits<double>::quiet_NaN(), steps = seconds, tolerance = seconds;
};

/// At the loosest tolerance such that all tighter ones have an error of at most `error`, or between
/// it and the next looser one; NaN if there is none.
AtError interpolate(double error, const Sweep& sweep);

/// Runs all contestants at all tolerances, given from loose to tight, in random order.
std::vector<Sweep> run_sweeps(const std::vector<Contestant>& contestants,
                              const std::vector<double>& tolerances, bool with_gradient);

/// run_sweeps(). Adds a table `name` of all runs, and a table
/// `name`_at_accuracy of the time that each contestant needs for a given accuracy.
std::vector<Sweep> race(const std::string& name, const std::string& what, bool with_gradient,
                        const std::vector<Contestant>& contestants,
                        const std::vector<double>& tolerances, Report* report);

}  // namespace codesign
