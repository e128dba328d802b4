// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_

#include <cstddef>

namespace codesign {

/// The compiled functions of Equations; each enumerator lists the arrays of results, in order.
enum class EquationFunction {
  kResidual,         ///< G, g
  kLinearization,    ///< G_q, G_v, G_z, G_t
  kConstraintErrors  ///< Phi, Phi_q v
};
constexpr std::size_t kEquationFunctions = 3;  ///< number of enumerators

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATION_FUNCTION_H_
