// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "mechanism_codesign/event.h"
#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Extreme values of the signals that constraints (`path:`, `final:`) and peaks read; doc/theory.md
/// (21a). For each signal in turn: its values at fixed instants, then its largest value in each
/// window between two instants, then its smallest value in each window.
struct Extremes {
  Eigen::VectorXd values;     ///< signal minus reference, in the unit of the signal
  Eigen::VectorXd times;      ///< when the signal has this value [s]
  Eigen::MatrixXd gradients;  ///< one column per value; empty unless requested
};

/// The derivatives that an evaluation computes besides the objective. kGaussNewton: the gradient,
/// and Evaluation::jacobian_root.
enum class Derivatives { kNone, kGradient, kGaussNewton };
inline Derivatives gradient_if(bool with_gradient) {
  return with_gradient ? Derivatives::kGradient : Derivatives::kNone;
}

/// The objective psi and its gradient by the tuned parameters at one design; doc/theory.md (21),
/// (22).
struct Evaluation {
  Status status;             ///< if not ok, objective and gradient are not valid
  double objective = 0.0;    ///< psi, in the units of the study's terms
  Eigen::VectorXd gradient;  ///< psi_rho, order of Problem::tuned_names(); empty unless requested
  /// Upper triangular R, p x p, with R^T R = J^T J and a diagonal that is not negative; J is the
  /// Jacobian of the residuals whose squares sum up to psi without its peaks, doc/theory.md (22a).
  /// Empty unless requested.
  Eigen::MatrixXd jacobian_root;
  Extremes extremes;  ///< empty if the study has neither constraints on signals nor peaks
  Statistics statistics;
  Warnings warnings;  ///< warnings of the run, as Simulation::warnings()
  /// of the run, as Simulation::events(); over scenarios the list of the first one and the number
  /// of all, without an order
  Events events;
};

/// Evaluates psi(rho) and its gradient. `solver.gradient` of the study selects direct sensitivities
/// (18) or the adjoint (18a); kGaussNewton always uses direct sensitivities. Holds a workspace that
/// is reused from call to call; not thread-safe, use one per thread.
class Evaluator {
 public:
  explicit Evaluator(const Problem& problem);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;
  Evaluator& operator=(Evaluator&&) noexcept;

  /// Runs the study at one design.
  /// @param rho the tuned parameters, in the order of Problem::tuned_names(); all other parameters
  /// keep their start values.
  /// @param cancel the evaluation ends with kCancelled soon after this is set, from any thread;
  /// null: never.
  Evaluation evaluate(const Eigen::VectorXd& rho, Derivatives derivatives,
                      const std::atomic<bool>* cancel = nullptr);
  Evaluation evaluate(const Eigen::VectorXd& rho, bool with_gradient,
                      const std::atomic<bool>* cancel = nullptr);
  /// Runs the study with values of all named parameters, in the order of Problem::all_parameters();
  /// the gradient has one entry per tuned parameter, as above.
  Evaluation evaluate_design(const std::vector<double>& parameters, Derivatives derivatives,
                             const std::atomic<bool>* cancel = nullptr);
  Evaluation evaluate_design(const std::vector<double>& parameters, bool with_gradient,
                             const std::atomic<bool>* cancel = nullptr);

 private:
  friend struct EvaluatorMaker;
  class Implementation;
  explicit Evaluator(std::unique_ptr<Implementation> implementation);

  std::unique_ptr<Implementation> implementation_;
};

/// The method that computes the reference of a gradient check.
enum class CheckMethod {
  /// complex step through the same sequence of steps; exact to rounding; only for `rosenbrock`
  kComplexStep,
  /// Ridders' extrapolated differences of runs with tight tolerances; independent of the steps
  kRidders,
};

/// What differences of the objective alone say of a gradient: along one direction d, from runs that
/// take other steps than the runs of the study, with another method, a hundredth of the tolerances
/// and a largest step; doc/theory.md (22c).
struct IndependentCheck {
  Eigen::VectorXd direction;  ///< d, in the units of the tuned parameters; empty: not computed
  double along = 0.0;         ///< d^T g of the gradient g under check
  double derivative = 0.0;    ///< of the objective along d, by differences
  double error = 0.0;         ///< estimate of the absolute error of `derivative`
  /// the difference that the study's own tolerances explain, and that moves no optimum
  double allowed = 0.0;
  double size = 0.0;                ///< max_k |d_k g_k|, or |derivative| if that is more
  double objective = 0.0;           ///< at the design itself, with the other steps
  std::string method;               ///< of the other steps, as in a study: "rodas5p"
  double relative_tolerance = 0.0;  ///< theirs
  double longest_step = 0.0;        ///< theirs [s]; 0: postures, which have no steps
  int evaluations = 0;              ///< of the objective; at most twelve
  Status status;                    ///< why nothing is known, if `direction` is empty
  Statistics statistics;            ///< sums over the evaluations

  bool is_known() const { return direction.size() > 0; }
  /// Whether the gradient is refuted: its difference is beyond `error` and `allowed`.
  bool disagrees() const { return is_known() && std::abs(along - derivative) > error + allowed; }
};

/// A gradient and an independently computed reference.
struct GradientCheck {
  Status status;
  CheckMethod method = CheckMethod::kComplexStep;  ///< the method that was used
  Evaluation evaluation;                           ///< objective and gradient g under check
  Eigen::VectorXd reference;                       ///< the reference gradient r
  Eigen::VectorXd reference_error;  ///< error estimate of the reference; zero for the complex step
  /// reference for the gradients in Evaluation::extremes; only for kComplexStep
  Eigen::MatrixXd extreme_reference;
  /// max_k |g_k - r_k| / max(|r_k|, 1e-3 max_j |r_j|), also over the extremes. Along a direction d:
  /// |d^T g - r| / max_k |d_k g_k|.
  double largest_relative_difference = 0;
  /// If not empty, the reference has one entry per column: the derivative along this direction in
  /// the space of the tuned parameters.
  Eigen::MatrixXd directions;
  /// By check_steps(): as `reference`, but through the steps of a run with a hundredth of the
  /// study's tolerances. Empty where that is not known.
  Eigen::VectorXd finer;
  /// As largest_relative_difference, of the gradient from `finer`: what the length of the steps
  /// costs. A complex step through the same steps does not see it.
  double largest_change = 0;
  IndependentCheck independent;  ///< by check_other_steps()
};

/// Computes the gradient at `rho` and a reference for it. With `idas` the method is always
/// kRidders, and its differences come from runs with `rosenbrock`, so that the two integrators
/// check each other.
GradientCheck check_gradient(const Problem& problem, const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
