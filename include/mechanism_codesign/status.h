// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace codesign {

/// Why a computation ended. Numerical failures are returned as values of this type, never thrown.
enum class StatusCode {
  kSuccess,
  kCancelled,
  kAssemblyFailed,          ///< no configuration satisfies Phi(q) = 0 near the start
  kInitialVelocityFailed,   ///< the given velocities contradict each other
  kInitialReactionsFailed,  ///< no (a, lambda) satisfies the equations of motion at the start
  /// the matrix of the equations of motion became singular (a dead point, a lock-up)
  kSingularMatrix,
  kStepSizeTooSmall,  ///< the error test required a step below the smallest allowed step
  kTooManySteps,      ///< the limit on the number of steps was reached before the end of the study
  kUnstableMotion,    ///< a body's speed exceeded a bound far above what its loads can explain
  kNonFinite,         ///< a value overflowed or became NaN
  kInvalidDesign,     ///< the parameters give an impossible mass, inertia or dimension
  /// several motions meet at this position (theory (19a)), or constraints lose rank in the run
  /// (theory (17c))
  kSingularConfiguration,
  kConstraintDrift,    ///< the constraints are violated by more than the tolerances explain
  kEnergyError,        ///< the energy balance is violated by more than the tolerances explain
  kInfeasible,         ///< an optimization ended outside its constraints
  kAlgorithmFailed,    ///< the optimization algorithm gave up
  kWorkerLost,         ///< a worker process has ended or does not answer
  kNonFiniteGradient,  ///< the objective is finite, its gradient is not
  kNoEquilibrium,      ///< no posture was found in which the mechanism rests
  kNotIdentifiable,    ///< the recordings do not determine all numbers to be identified
  kSwitchHolds,        ///< the motion on both sides of a switch leads back to it
};

/// Snake-case name, as sent over ROS and printed in JSON: "assembly_failed".
const char* name_of(StatusCode code);

/// Outcome of a computation.
struct Status {
  StatusCode code = StatusCode::kSuccess;
  double time = 0.0;  ///< simulated time at which the computation ended [s]
  std::string cause;  ///< one sentence for the user; may be empty on success

  bool ok() const { return code == StatusCode::kSuccess; }
  /// Whether the computation was interrupted from outside, so that its outcome is no property of
  /// the design.
  bool is_interrupted() const {
    return code == StatusCode::kCancelled || code == StatusCode::kWorkerLost;
  }
};

/// Code, time and cause of a status: "step_size_too_small at t = 0.5 s: the step size fell below
/// ...".
std::string describe(const Status& status);

/// Cause and time of a status, for replies that have the code in a field of its own: "the step size
/// fell below ... (at t = 0.5 s)".
std::string reason(const Status& status);

}  // namespace codesign
