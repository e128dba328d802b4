// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_STATUS_H_
#define MECHANISM_CODESIGN_STATUS_H_

#include <string>

namespace codesign {

/// Why a computation ended. Numerical trouble is a value, never an exception.
enum class StatusCode {
  kSuccess,
  kCancelled,
  kAssemblyFailed,          ///< no configuration satisfies Phi(q) = 0 near the start
  kInitialVelocityFailed,   ///< the given velocities contradict each other
  kInitialReactionsFailed,  ///< no (a, lambda) satisfies the equations of motion at the start
  kSingularMatrix,          ///< the augmented matrix lost its rank (a dead point, a lock-up)
  kStepSizeTooSmall,
  kTooManySteps,
  kUnstableMotion,         ///< a body became faster than it has reason to be
  kNonFinite,              ///< a value overflowed or became NaN
  kInvalidDesign,          ///< the parameters give a mass, inertia or dimension that cannot be
  kSingularConfiguration,  ///< the start is a position where the mechanism may move in several ways at once, and none was chosen
  kConstraintDrift,        ///< the constraints are violated by more than the tolerances explain
  kEnergyError,            ///< the energy balance is violated by more than the tolerances explain
  kInfeasible,             ///< an optimization ended outside its constraints
  kAlgorithmFailed,        ///< the optimization algorithm gave up
  kNonFiniteGradient,      ///< the objective is finite, its gradient is not
};

/// Snake-case name, as sent over ROS and printed in JSON: "assembly_failed".
const char* name_of(StatusCode code);

/// Outcome of a computation, with the time [s] it was reached and its cause in a sentence.
struct Status {
  StatusCode code = StatusCode::kSuccess;
  double time = 0.0;
  std::string cause;

  bool ok() const { return code == StatusCode::kSuccess; }
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_STATUS_H_
