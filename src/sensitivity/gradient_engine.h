// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_ENGINE_H_
#define MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_ENGINE_H_

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <vector>

#include "integration/integrator.h"

namespace codesign {

/// An integration that can carry the gradient of psi along; one implementation per integrator. Reusable; not thread-safe.
class GradientEngine {
 public:
  virtual ~GradientEngine() = default;

  /// Assembles the start of a design. @param parameters all named parameters.
  virtual Status start(const std::vector<double>& parameters, bool with_gradient) = 0;
  /// Takes one step, with its sensitivities if start() was asked for them, not beyond `limit` [s].
  virtual Status advance(double limit) = 0;

  /// Time reached [s].
  virtual double time() const = 0;
  /// psi if the motion ended here: the integral so far and the terminal terms.
  virtual double objective() = 0;
  /// d psi / d rho at the same point, in the order of Study::tuned.
  virtual void gradient(Eigen::VectorXd* gradient) = 0;
  virtual const Statistics& statistics() const = 0;
  /// What the run gives reason to doubt.
  virtual Warnings warnings() const = 0;
  /// From now on advance() and gradient() end soon after `cancel` is set, advance() with kCancelled. Null: never.
  virtual void obey(const std::atomic<bool>* cancel) = 0;
};

/// Whether the study's gradient is made backwards: where it asks for the adjoint, or leaves the choice and the adjoint is expected to be
/// cheaper; doc/decisions/0018-adjoint.md.
bool prefers_adjoint(const CompiledSystem& system);

/// The engine of the study's integrator. @param cancel if given and set, null comes soon.
std::unique_ptr<GradientEngine> make_gradient_engine(const CompiledSystem& system, const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_GRADIENT_ENGINE_H_
