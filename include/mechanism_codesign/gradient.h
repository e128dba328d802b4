// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_GRADIENT_H_
#define MECHANISM_CODESIGN_GRADIENT_H_

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <vector>

#include "mechanism_codesign/problem.h"
#include "mechanism_codesign/statistics.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// The objective psi and its gradient with respect to the tuned parameters, at one design.
struct Evaluation {
  Status status;
  double objective = 0.0;
  Eigen::VectorXd gradient;  ///< in the order of Study::tuned; empty if not asked for
  Statistics statistics;
  Warnings warnings;  ///< of this evaluation, as Simulation::warnings()
};

/// Evaluates psi(rho) and its gradient by direct sensitivities. Holds a workspace that is reused from call to call: one per thread.
class Evaluator {
 public:
  explicit Evaluator(const Problem& problem);
  explicit Evaluator(std::shared_ptr<const CompiledSystem> system);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;
  Evaluator& operator=(Evaluator&&) noexcept;

  /// @param rho the tuned parameters, in the order of Study::tuned; the others keep their defaults.
  /// @param cancel if given and set, the evaluation ends early with kCancelled.
  Evaluation evaluate(const Eigen::VectorXd& rho, bool with_gradient, const std::atomic<bool>* cancel = nullptr);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// How a gradient is checked.
enum class CheckMethod {
  kComplexStep,  ///< complex step through the same sequence of steps, of `rosenbrock` alone; exact to rounding
  kRidders,      ///< Ridders' extrapolated differences of tight integrations; independent of the step sequence
};

/// A gradient beside an independently computed one.
struct GradientCheck {
  Status status;
  CheckMethod method = CheckMethod::kComplexStep;  ///< that was used
  Evaluation evaluation;
  Eigen::VectorXd reference;
  Eigen::VectorXd reference_error;         ///< its own error estimate (zero for the complex step)
  double largest_relative_difference = 0;  ///< max_k |g_k - r_k| / max(|r_k|, 1e-3 max_j |r_j|)
};

/// Computes a gradient twice. That of `idas` is always checked by differences, and they are of `rosenbrock`: each integrator is the other's
/// check.
GradientCheck check_gradient(const Problem& problem, const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel = nullptr);
GradientCheck check_gradient(const std::shared_ptr<const CompiledSystem>& system, const Eigen::VectorXd& rho, CheckMethod method,
                             const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_GRADIENT_H_
