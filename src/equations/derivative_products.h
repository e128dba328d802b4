// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_DERIVATIVE_PRODUCTS_H_
#define MECHANISM_CODESIGN_EQUATIONS_DERIVATIVE_PRODUCTS_H_

#include "equations/compiled_system.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

/// Derivative of (G, g) along a direction (q, s, v, z) of the state, G_q q + G_s s + G_v v + G_z z and the same of g behind it.
/// @param result columns() + 1 entries, overwritten.
void directional_derivative(const CompiledSystem& system, const Linearization<double>& derivatives, const State<double>& direction,
                            VectorX<double>* result);

/// result -= factor * G_q q, on columns() entries.
/// @param q n entries.
void subtract_position_product(const CompiledSystem& system, const Linearization<double>& derivatives, const double* q, double factor,
                               double* result);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_DERIVATIVE_PRODUCTS_H_
