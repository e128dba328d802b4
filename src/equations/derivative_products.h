// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/compiled_system.h"
#include "math/span.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

/// The derivative of (G, g), theory (14), along a direction of the state: G_q q + G_s s + G_v v + G_z z; the last entry is the derivative
/// of g. The time of `direction` is ignored.
/// @param result resized to Layout::columns() + 1 and overwritten.
void directional_derivative(const CompiledSystem& system, const Linearization<double>& derivatives, const State<double>& direction,
                            VectorX<double>* result);

/// result -= factor * G_q q. @param q n entries. @param result Layout::columns() entries; g has none.
void subtract_position_product(const CompiledSystem& system, const Linearization<double>& derivatives, In<double> q, double factor,
                               Out<double> result);

}  // namespace codesign
