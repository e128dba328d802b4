// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// A warning `bound_beyond_setpoints` for each bound of `path`, and each bounded peak, that the
/// motion of the set-points exceeds by more than a hundredth: what record_efforts() finds along
/// them at this design, without controllers and their errors. None where the set-points determine
/// no motion, and of signals that need controllers.
/// @param parameters all named parameters.
Warnings find_bounds_beyond_setpoints(const Problem& problem, const std::vector<double>& parameters,
                                      const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
