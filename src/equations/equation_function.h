// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_

#include <cstddef>

namespace codesign {

/// What a recording holds; each part is recorded when it is first needed.
enum class EquationPart {
  kMotion,  ///< kResidual, kLinearization, kConstraintErrors
  kSignals  ///< kTerminal and the watched signals
};

/// The recorded functions of Equations; each enumerator lists the arrays of results, in order.
enum class EquationFunction : std::size_t {
  kResidual,          ///< G, g
  kLinearization,     ///< G_q, G_v, G_z, G_t
  kConstraintErrors,  ///< Phi, Phi_q v
  kTerminal,          ///< w, its gradient
  kFirstWatched       ///< signal minus reference, its gradient
};

/// The function of the k-th watched signal.
constexpr EquationFunction watched_function(std::size_t k) {
  return static_cast<EquationFunction>(static_cast<std::size_t>(EquationFunction::kFirstWatched) + k);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_
