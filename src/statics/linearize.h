// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "linear/linear_model.h"

namespace codesign {

class CompiledSystem;

/// Small motions about the equilibrium of find_equilibrium(), with its errors and statuses.
LinearModel linearize_at_rest(const CompiledSystem& system, const std::vector<double>& parameters,
                              const LinearQuestion& question,
                              const std::atomic<bool>* cancel = nullptr);

/// Small deviations from a run at time t, as if its coefficients stayed as they are then. All
/// friction counts, with the slope that it has at the speeds of the run.
/// @param t [s] at most the duration of the study. @throws InputError for a later time, for a
/// study of postures, and for friction at a given speed. Statuses: those of a run.
LinearModel linearize_in_motion(const CompiledSystem& system, const std::vector<double>& parameters,
                                const LinearQuestion& question, double t,
                                const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
