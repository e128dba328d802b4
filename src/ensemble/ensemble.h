// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "engine/evaluation_engine.h"
#include "ensemble/scenario.h"
#include "sensitivity/gradient_check.h"

namespace codesign {

/// The objective of one design over all scenarios.
struct EnsembleEvaluation {
  /// The measure and its gradient, the sums of the statistics, and the warnings of all scenarios,
  /// each once. With a single scenario: the evaluation of that scenario.
  Evaluation total;
  Eigen::VectorXd values;     ///< psi of each scenario; empty if one failed and `total` is not ok
  Eigen::MatrixXd gradients;  ///< one column per scenario
  /// The extreme values of the watched signals of each scenario; empty without watched signals.
  std::vector<Extremes> extremes;
  Eigen::VectorXd by_value;  ///< derivative of the measure by psi of each scenario
  double threshold = 0.0;    ///< for kCvar and kWorst: the value at risk
  /// indices of scenarios that could not be integrated and count in the tail; `total` warns of them
  std::vector<int> failed;
};

/// The evaluations of one design, one per scenario in their order.
std::vector<EvaluationTask> tasks_at(const std::vector<Scenario>& scenarios,
                                     const Eigen::VectorXd& rho, Derivatives derivatives);

/// Evaluates designs over scenarios: doc/theory.md (24a) gives the measures. Thread-safe: several
/// searches may use one ensemble.
class Ensemble {
 public:
  /// @param scenarios weights with sum 1. @param engine does the evaluations.
  Ensemble(std::vector<Scenario> scenarios, const RobustOptions& options,
           std::shared_ptr<EvaluationEngine> engine);
  /// Takes the scenarios of a problem and the engine that its study requests.
  /// @param designs the largest number of designs evaluated at the same time. @param records memory
  /// and counts of the job.
  explicit Ensemble(const Problem& problem, int designs = 1, EngineRecords records = {});
  /// The same with one scenario more; the weights are scaled to the sum 1.
  Ensemble with(Scenario scenario) const;
  /// Takes the run of a compiled study as the only scenario.
  explicit Ensemble(std::shared_ptr<const CompiledSystem> system);

  /// @param derivatives kGaussNewton also computes Evaluation::jacobian_root of `total`, for the
  /// measure kMean; doc/theory.md (22b).
  EnsembleEvaluation evaluate(const Eigen::VectorXd& rho, Derivatives derivatives,
                              const std::atomic<bool>* cancel = nullptr) const;
  EnsembleEvaluation evaluate(const Eigen::VectorXd& rho, bool with_gradient,
                              const std::atomic<bool>* cancel = nullptr) const {
    return evaluate(rho, gradient_if(with_gradient), cancel);
  }

  const std::vector<Scenario>& scenarios() const { return scenarios_; }
  const Eigen::VectorXd& weights() const { return weights_; }
  const RobustOptions& options() const { return options_; }
  EvaluationEngine& engine() const { return *engine_; }

 private:
  bool collect(const std::vector<Evaluation>& members, bool with_gradient,
               EnsembleEvaluation* result) const;
  void check_finite(double time, EnsembleEvaluation* result) const;
  void combine_roots(const std::vector<Evaluation>& members, EnsembleEvaluation* result) const;
  bool fill_tail(const std::vector<std::size_t>& failed, const std::vector<Evaluation>& members,
                 EnsembleEvaluation* result) const;

  std::vector<Scenario> scenarios_;
  RobustOptions options_;
  Eigen::VectorXd weights_;
  std::shared_ptr<EvaluationEngine> engine_;
};

/// check_gradient() for the measure of an ensemble: the reference is the derivative of the measure
/// by each scenario's psi, times the reference of that scenario's gradient. Scenarios on which the
/// measure does not depend are not computed.
GradientCheck check_gradient(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                             CheckMethod method, const std::atomic<bool>* cancel = nullptr);

/// The number of directions of check_along().
constexpr int kCheckedDirections = 1;

/// A check that costs the same for any number of parameters: along kCheckedDirections of
/// check_directions(), or by each parameter if they are not more.
GradientCheck check_along(const Ensemble& ensemble, const Eigen::VectorXd& rho, CheckMethod method,
                          const std::atomic<bool>* cancel = nullptr);

/// Sets GradientCheck::finer and largest_change of an ended check, with the warning
/// `coarse_gradient` in its evaluation if the gradient changes by more than a hundredth, and where
/// check_other_steps() was called before, by more than what moves no optimum. Does
/// nothing where a run cannot be repeated (idas, postures, bands), where its steps obey
/// solver.sensitivity_tolerance, and if a run with smaller tolerances fails.
void check_steps(const Ensemble& ensemble, const Eigen::VectorXd& rho,
                 const std::atomic<bool>* cancel, GradientCheck* check);

/// Whether a gradient and its reference differ by more than rounding, or the error of differences,
/// explains.
bool disagrees(const GradientCheck& check);

}  // namespace codesign
