// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/status.h"

namespace codesign {

const char* name_of(StatusCode code) {
  switch (code) {
    case StatusCode::kSuccess:
      return "success";
    case StatusCode::kCancelled:
      return "cancelled";
    case StatusCode::kAssemblyFailed:
      return "assembly_failed";
    case StatusCode::kInitialVelocityFailed:
      return "initial_velocity_failed";
    case StatusCode::kInitialReactionsFailed:
      return "initial_reactions_failed";
    case StatusCode::kSingularMatrix:
      return "singular_matrix";
    case StatusCode::kStepSizeTooSmall:
      return "step_size_too_small";
    case StatusCode::kTooManySteps:
      return "too_many_steps";
    case StatusCode::kUnstableMotion:
      return "unstable_motion";
    case StatusCode::kNonFinite:
      return "non_finite";
    case StatusCode::kInvalidDesign:
      return "invalid_design";
    case StatusCode::kSingularConfiguration:
      return "singular_configuration";
    case StatusCode::kConstraintDrift:
      return "constraint_drift";
    case StatusCode::kEnergyError:
      return "energy_error";
    case StatusCode::kInfeasible:
      return "infeasible";
    case StatusCode::kAlgorithmFailed:
      return "algorithm_failed";
    case StatusCode::kNonFiniteGradient:
      return "non_finite_gradient";
    case StatusCode::kWorkerLost:
      return "worker_lost";
    case StatusCode::kNotIdentifiable:
      return "not_identifiable";
  }
  return "unknown";
}

}  // namespace codesign
