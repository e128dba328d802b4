// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/motion_study.h"
#include "jobs/json.h"
#include "linear/linear_model.h"

namespace codesign {

/// Sets `stability`, `verdict`, `modes` and, if a controller is sampled, `period`.
void add_stability(const LinearModel& model, Json* object);
/// Sets `states`, `inputs`, `outputs`, `A`, `B`, `C`, `D` (lists of rows).
void add_matrices(const StateSpace& system, Json* object);
/// By controller that compares a signal with a setpoint: the signal.
Json measured_json(const std::vector<ControllerDescription>& controllers);
/// By controller: the margins of visit_margins() that there are, with their frequencies, and
/// L at all of them.
Json loops_json(const LinearModel& model);

}  // namespace codesign
