// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_BENCHMARK_WORK_PRECISION_H_
#define MECHANISM_CODESIGN_BENCHMARK_WORK_PRECISION_H_

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "benchmark/report.h"
#include "problem/load_problem.h"

namespace codesign {

/// The objective and its gradient as far as they are known.
struct Reference {
  double psi;
  Eigen::VectorXd gradient;
};

/// What one run of a solver gave.
struct Outcome {
  double error =
      std::numeric_limits<double>::quiet_NaN();  ///< relative; of a gradient the largest over its components; NaN if the run failed
  long steps = 0;
};

Outcome outcome_of(const Reference& reference, bool with_gradient, double psi, const Eigen::VectorXd& gradient, long steps);

/// A solver: prepare() sets it up for a tolerance, with or without the gradient; what it returns runs it once.
struct Contestant {
  std::string name;
  std::function<std::function<Outcome()>(double tolerance, bool with_gradient)> prepare;
};

/// A solver of ours, by the name that with_solver() takes.
Contestant own_solver(const Problem& problem, const std::string& name, const Reference& reference);

/// One point of a sweep over tolerances.
struct Measured {
  double tolerance;
  Outcome outcome;
  double seconds;  ///< CPU, median
};
using Sweep = std::vector<Measured>;

/// The cost of an accuracy [s]: of the loosest tolerance from which on every tighter one keeps to it. NaN if none does.
double seconds_to(double error, const Sweep& sweep);

/// Runs all contestants at all tolerances, from loose to tight, in one shuffled run; adds a table of all runs, `name`, and one of the
/// time that each takes to a given accuracy, `name`_at_accuracy.
std::vector<Sweep> race(const std::string& name, const std::string& what, bool with_gradient, const std::vector<Contestant>& contestants,
                        const std::vector<double>& tolerances, Report* report);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_BENCHMARK_WORK_PRECISION_H_
