// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <vector>

#include "integration/integrator.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

// Estimated cost of a gradient, in units of one simulation without gradient; measured on mechanisms
// of 3 to 16 bodies, doc/decisions/0083-transposed-products.md. Lanes are evaluated in groups of
// eight or four.
constexpr double kEightLanes = 2.4, kFourLanes = 1.7;

/// Cost of direct sensitivities by this number of parameters. Beyond eight, eight more directions
/// control the steps, see control_directions().
inline double direct_cost(int parameters) {
  double cost = parameters > 8 ? 1.0 + kEightLanes : 1.0;
  for (; parameters > 4; parameters -= 8) cost += kEightLanes;
  return parameters > 0 ? cost + kFourLanes : cost;
}

/// Cost of the adjoint method by any number of parameters, with the directions that control the
/// steps.
constexpr double kAdjointCost = 4.0 + kFourLanes;

/// An integration that can compute the gradient of psi; one implementation per method. start() may
/// be called again. Where the end of a run depends on the design, results at
/// Integrator::has_ended() are those of an end that moves, theory (21g). Not thread-safe.
class GradientEngine {
 public:
  virtual ~GradientEngine() = default;

  /// Assembles the initial state of a design. @param parameters all named parameters
  /// (Study::parameters order). @param derivatives kGradient: gradient() will be called;
  /// kGaussNewton: gradient() and jacobian_root() will be called. @returns the status of
  /// assemble_start(), or kInvalidDesign for kGaussNewton and terms that are no squares.
  virtual Status start(const std::vector<double>& parameters, Derivatives derivatives) = 0;
  /// Takes one step that ends at `limit` [s] or before, with sensitivities if start() was called
  /// with derivatives.
  virtual Status advance(double limit) = 0;

  /// The integrator of the run.
  virtual const Integrator& integrator() const = 0;
  /// Time reached [s].
  double time() const { return integrator().state().t; }
  /// psi of a study that ends at time(): the integral so far plus the terminal terms, doc/theory.md
  /// (21).
  virtual double objective() = 0;
  /// d psi / d rho for the same end, p entries in the order of Study::tuned; NaN if it cannot be
  /// computed or was cancelled. start() must have been called with gradient.
  virtual void gradient(Eigen::VectorXd* gradient) = 0;
  /// Evaluation::jacobian_root for the same end, after gradient(); start() must have been called
  /// with kGaussNewton.
  virtual void jacobian_root(Eigen::MatrixXd* root) = 0;
  /// The numbers of the watched signals of a study that ends at time(), with derivatives if start()
  /// was called with gradient.
  virtual const Extremes& extremes() const = 0;
  virtual const Statistics& statistics() const = 0;
  /// Warnings about the run since start().
  virtual Warnings warnings() const = 0;
  /// Its events; null where none are seen.
  virtual const EventLog* events() const { return nullptr; }
  /// Once `cancel` is set (by any thread), advance() and gradient() end soon, advance() with
  /// kCancelled. nullptr: no cancellation.
  virtual void obey(const std::atomic<bool>* cancel) = 0;
};

/// Whether the gradient is computed by the adjoint: if solver.gradient is `adjoint`, or `auto` and
/// the adjoint has the lower estimated cost; doc/decisions/0083-transposed-products.md. Only the
/// integrator `rosenbrock` has an adjoint.
bool prefers_adjoint(const CompiledSystem& system);

/// The engine for the study's integrator and gradient method. @param system must outlive it. @param
/// derivatives the highest level that start() will request; kGaussNewton always uses direct
/// sensitivities.
std::unique_ptr<GradientEngine> make_gradient_engine(
    const CompiledSystem& system, Derivatives derivatives = Derivatives::kGradient);

}  // namespace codesign
