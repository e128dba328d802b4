// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_engine.h"

#include "control/control_clock.h"
#include "equations/compiled_system.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cost.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
bool prefers_adjoint(const CompiledSystem& system) {
  const SolverOptions& options = system.study().solver;
  if (options.integrator != IntegratorKind::kRosenbrock || options.gradient == GradientMethod::kDirect) return false;
  // The adjoint has no derivatives of the extreme values of watched signals.
  if (!system.watched().empty()) return false;
  // Nor does it go back over the jumps of sampled controllers.
  if (!ControlClock(system.study()).is_empty()) return false;
  if (options.gradient == GradientMethod::kAdjoint) return true;
  // solver.sensitivity_tolerance tests the errors of direct sensitivities, which the adjoint does not compute.
  return options.sensitivity_tolerance <= 0.0 && direct_cost(static_cast<int>(system.study().tuned.size())) > kAdjointCost;
}

std::unique_ptr<GradientEngine> make_gradient_engine(const CompiledSystem& system, Derivatives derivatives) {
  if (system.study().solver.integrator == IntegratorKind::kIdas) return std::make_unique<IdasGradient>(system);
  if (derivatives == Derivatives::kGaussNewton) return std::make_unique<RosenbrockGradient>(system);
  if (prefers_adjoint(system)) return std::make_unique<AdjointGradient>(system);
  return std::make_unique<RosenbrockGradient>(system);
}

}  // namespace codesign
