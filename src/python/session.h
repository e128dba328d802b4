// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/ensemble.h"
#include "jobs/run_recorder.h"
#include "linear/linear_model.h"
#include "problem/load_problem.h"

namespace codesign::python {

/// A run as a table.
struct RunTable {
  RunSummary summary;
  std::vector<std::string> names;  ///< of the columns: `time`, then the signals
  std::size_t room = 0;            ///< of each column in `values`
  std::size_t rows = 0;            ///< instants that the run has reached
  std::vector<double> values;      ///< column after column
};

/// psi as a sum of squares in p + 1 coordinates, doc/theory.md (22a): r, whose square is psi, and
/// J, (p + 1) x p, with 2 J^T r = psi_rho and J^T J the Gauss-Newton matrix.
struct Squares {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
};

/// @param evaluation with Derivatives::kGaussNewton. Empty if it failed.
Squares squares_of(const Evaluation& evaluation);

/// A problem with the workspaces of its evaluations. Thread-safe: evaluations of several threads
/// run side by side.
class Session {
 public:
  explicit Session(Problem problem);

  const Problem& problem() const { return problem_; }

  /// Values of all named parameters: the start values, those of `rho` (empty: none; else one entry
  /// per tuned parameter, which need not lie within bounds), those of `settings`. @throws
  /// InputError as Problem::parameters(), and for a rho of another size or with numbers that are
  /// not finite
  std::vector<double> design(const std::optional<std::vector<double>>& rho,
                             const ParameterSettings& settings) const;

  /// The objective over all runs and samples of the study, as a search evaluates it. A parameter
  /// that is not tuned has its value in `parameters` in all runs and samples that do not set it.
  /// @param parameters design(). @throws InputError for a study without an objective and, with
  /// derivatives, without tuned parameters; for kGaussNewton also if the objective is no sum of
  /// squares.
  Evaluation evaluate(const std::vector<double>& parameters, Derivatives derivatives,
                      const std::atomic<bool>* cancel);

  /// The same problem with gradients by the adjoint, compiled at the first call. @throws InputError
  /// if it has none.
  Session& adjoint();

  /// The study's run at a design. @param signals empty: default_signals(). @throws InputError for a
  /// signal that does not exist, and fewer than two samples
  RunTable run(const std::vector<double>& parameters, const std::vector<std::string>& signals,
               int samples, const std::atomic<bool>* cancel) const;

  /// Small motions of the study at a design, with margins. @param at [s] of the run; none: about
  /// the equilibrium. @param friction of kLinearFrictionNames. @throws InputError as run(), for
  /// another friction, and as linearize_at_rest() and linearize_in_motion()
  LinearModel linearize(const std::vector<double>& parameters,
                        const std::vector<std::string>& outputs, const std::string& friction,
                        std::optional<double> at, const std::atomic<bool>* cancel) const;

 private:
  std::vector<SignalDescription> checked(const std::vector<std::string>& signals) const;
  std::vector<Scenario> scenarios_at(const std::vector<double>& parameters) const;
  /// Whether an evaluation is one run: each thread then has an engine of its own. Else they share
  /// one, whose workers serve all.
  bool is_serial() const { return scenarios_.size() == 1; }
  std::shared_ptr<EvaluationEngine> take_engine();
  void give_back(const std::shared_ptr<EvaluationEngine>& engine);

  const Problem problem_;
  const std::vector<double> start_;
  const std::vector<Scenario> scenarios_;
  const std::vector<SignalDescription> default_signals_;
  std::mutex mutex_;                                        ///< guards the members below
  std::vector<std::shared_ptr<EvaluationEngine>> engines_;  ///< free ones, or the shared one
  std::unique_ptr<Session> adjoint_;
};

}  // namespace codesign::python
