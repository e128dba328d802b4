// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/status.h"
#include "sparse/sparsity.h"
#include "system/state.h"

namespace codesign {

class Integrator;

/// Solves for the z of a state, in the mode that the equations hold, and computes the rates of the
/// motion there: q' = v, v' = a, s' = sigma, and z' = -G_z^-1 (G_t + G_q v + G_v a + G_s sigma).
/// The rates of a dense output have its error instead. @param state its q, v, s and t are given.
/// @param rates resized [per s]. @returns a failure of RateSolution::solve().
Status solve_motion(Integrator* integrator, State<double>* state, State<double>* rates);

/// The rate of a number x(q, v, s, z, t) along given rates: x_t + x_q q' + x_v v' + x_s s' + x_z z'
/// [unit of x per s].
double rate_along(const SparseGradient<double>& gradient, const State<double>& rates,
                  const Layout& layout);

}  // namespace codesign
