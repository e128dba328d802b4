// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_H_

#include <functional>
#include <string>
#include <vector>

#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/optimizer_options.h"

namespace codesign {

/// One trial point of an optimization.
struct Trial {
  int evaluation = 0;  ///< 1, 2, ...
  int iteration = 0;   ///< improvements of the best point so far
  Status status;       ///< not ok: the point could not be assembled or integrated, and was stepped back from
  double objective = 0.0;
  double gradient_norm = 0.0;  ///< of the gradient scaled by the parameters' ranges
  Eigen::VectorXd gradient;
  Eigen::VectorXd rho;
  double best_objective = 0.0;
};

/// Called after each trial point; returning false cancels, keeping the best point.
using TrialObserver = std::function<bool(const Trial&)>;

struct OptimizationResult {
  /// Ok; cancelled; why not even the start could be evaluated; kAlgorithmFailed; or kInfeasible, where no point within the constraints was
  /// found. In all cases but the third the best point is below.
  Status status;
  std::string termination;  ///< snake case: "objective_tolerance_reached", "max_evaluations_reached", "cancelled", ...
  double initial_objective = 0.0;
  double objective = 0.0;  ///< at `rho`, the best feasible point seen
  Eigen::VectorXd initial_gradient;
  Eigen::VectorXd gradient;  ///< at `rho`
  Eigen::VectorXd initial_rho;
  Eigen::VectorXd rho;
  int iterations = 0;
  int evaluations = 0;
  int failed_evaluations = 0;
  Eigen::VectorXd margins;       ///< of the study's constraints at `rho`; negative: not met
  Statistics statistics;         ///< summed over the evaluations; drift and energy error: those of the worst evaluation
  Warnings warnings;             ///< of the best point, and of the search: a parameter without influence, or on its bound
  std::vector<bool> influences;  ///< of each tuned parameter: whether the objective changed with it at any point that was tried
};

/// Minimizes psi(rho) within the bounds and the parameter constraints, from the parameters' start values.
/// @param options in place of the study's; without them Problem::optimizer_options().
/// @param cancel ends the search soon after it is set (from any thread), with the best point so far; null: never.
/// @throws InputError for options that contradict each other (e.g. constraints with an algorithm that takes none).
OptimizationResult optimize(const Problem& problem, const TrialObserver& observer = {}, const std::atomic<bool>* cancel = nullptr);
OptimizationResult optimize(const Problem& problem, const OptimizerOptions& options, const TrialObserver& observer = {},
                            const std::atomic<bool>* cancel = nullptr);
/// The same of a compiled system.
OptimizationResult optimize(const std::shared_ptr<const CompiledSystem>& system, const OptimizerOptions& options,
                            const TrialObserver& observer = {}, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_H_
