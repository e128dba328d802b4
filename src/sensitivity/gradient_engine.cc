// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_engine.h"

#include "control/control_clock.h"
#include "equations/compiled_system.h"
#include "sensitivity/adjoint_gradient.h"
#include "sensitivity/gradient_cost.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"
#include "text/cancel.h"

namespace codesign {
namespace {

/// The plan of lanes if the gradient is to be computed by the adjoint.
std::optional<LanePlan> backward_plan(const CompiledSystem& system, const std::atomic<bool>* cancel) {
  const SolverOptions& options = system.study().solver;
  if (options.integrator != IntegratorKind::kRosenbrock || options.gradient == GradientMethod::kDirect) return std::nullopt;
  // The adjoint has no derivatives of the extreme values of watched signals.
  if (!system.watched().empty()) return std::nullopt;
  // Nor does it go back over the jumps of sampled controllers.
  if (!ControlClock(system.study()).is_empty()) return std::nullopt;
  if (options.gradient == GradientMethod::kAdjoint) return plan_lanes(system, cancel);
  // solver.sensitivity_tolerance tests the errors of direct sensitivities, which the adjoint does not compute.
  if (options.sensitivity_tolerance > 0.0) return std::nullopt;
  const int parameters = static_cast<int>(system.study().tuned.size());
  if (direct_cost(parameters) <= adjoint_cost(1)) return std::nullopt;
  LanePlan plan = plan_lanes(system, cancel);
  if (direct_cost(parameters) <= adjoint_cost(plan.lanes)) return std::nullopt;
  return plan;
}

}  // namespace

bool prefers_adjoint(const CompiledSystem& system) { return backward_plan(system, nullptr).has_value(); }

std::unique_ptr<GradientEngine> make_gradient_engine(const CompiledSystem& system, const std::atomic<bool>* cancel,
                                                     Derivatives derivatives) {
  if (system.study().solver.integrator == IntegratorKind::kIdas) return std::make_unique<IdasGradient>(system);
  if (derivatives == Derivatives::kGaussNewton) return std::make_unique<RosenbrockGradient>(system);
  std::optional<LanePlan> plan = backward_plan(system, cancel);
  if (is_set(cancel)) return nullptr;
  if (plan) return std::make_unique<AdjointGradient>(system, std::move(*plan));
  return std::make_unique<RosenbrockGradient>(system);
}

}  // namespace codesign
