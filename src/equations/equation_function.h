// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "description/objective_part.h"
#include "math/arrays.h"

namespace codesign {

/// What a recording holds; each part is recorded when it is first needed.
enum class EquationPart {
  /// kResidual, kConstraintErrors, kSwitches, and what no other part has: kTurns, kEnergies,
  /// kRates, kAccelerations and kLinearization
  kMotion,
  kSignals,  ///< kTerminal, the residuals of the objective and the watched signals
  kStart,    ///< kPlacement and the controllers' functions
  /// kLinearization, where kRates are recorded without it, CompiledSystem::has_rates_apart()
  kLinearized,
  /// kRates and kAccelerations, where simulations differentiate without a program,
  /// CompiledSystem::compresses_jacobian()
  kRates,
  kEnd  ///< number of parts
};
constexpr auto kEquationParts = to_index(EquationPart::kEnd);

/// The recorded functions of Equations, numbered in each part; each enumerator lists the arrays of
/// results, in order.
enum class EquationFunction : std::size_t {
  kResidual = 0,      ///< G, g
  kLinearization,     ///< G_q, G_v, G_z, G_t
  kConstraintErrors,  ///< Phi, Phi_q v
  /// per switch of the residual, EquationVariant::mode(), the difference y - x of which it is the
  /// sign, positive where x < y; and y
  kSwitches,
  kExpressions,  ///< the values of the study's expressions of signals, then g; values only
  kRates,        ///< G, g, G_z; values only
  /// z with G = 0, g, values of MassFactor; values only, and only where
  /// EquationVariant::has_accelerations()
  kAccelerations,
  kEnergies,   ///< body_energies(), their bodies; values only, with a forest
  kTurns,      ///< those joint positions in State::turns that are of cut pairs; values only
  kMotionEnd,  ///< number of functions of the part

  kTerminal = 0,       ///< w
  kTerminalGradient,   ///< w, its gradient
  kIntegralResiduals,  ///< theory (22a), one per term of the integrand
  kTerminalResiduals,  ///< one per terminal term
  /// signal minus reference; then a function with its gradient as well; then the same of the other
  /// watched signals
  kFirstWatched,

  kPlacement = 0,  ///< q and v at the tree coordinates theta and their rates, in place of q and v
  kStuckSlips,     ///< stuck_slips(): accelerations, limits
  kBristles,       ///< the extra states after begin_bristles()
  /// two functions of each controller: the output and the extra states after its first sample, or
  /// the start of a continuous one; after others
  kFirstController
};

/// The function of the k-th watched signal, and of kTerminal or a watched signal with its gradient.
constexpr EquationFunction watched_function(std::size_t k) {
  return static_cast<EquationFunction>(to_index(EquationFunction::kFirstWatched) + 2 * k);
}
constexpr EquationFunction with_gradient(EquationFunction function) {
  return static_cast<EquationFunction>(to_index(function) + 1);
}

/// A function of a controller.
enum class ControllerFunction : std::size_t { kFirstSample, kSample, kEnd };
constexpr EquationFunction controller_function(int controller, ControllerFunction which) {
  return static_cast<EquationFunction>(to_index(EquationFunction::kFirstController) +
                                       to_index(ControllerFunction::kEnd) * to_index(controller) +
                                       to_index(which));
}

}  // namespace codesign
