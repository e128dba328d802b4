// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "description/motion_study.h"
#include "description/robot.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Builds the system of a model and a study: assembles the initial state, (19), finds redundant
/// constraints there and decides which rows are dropped, doc/theory.md (23), and checks that every
/// motion has inertia, (14a). A study whose expressions switch is not integrated by `idas`: the
/// system's own study then says `rosenbrock`.
/// @param warnings receives `inexact_loop`, `other_integrator`, `undetermined_friction` and
/// `undetermined_reaction`, if not null.
/// @throws InputError for a mechanism whose equations of motion cannot be set up: two masses on one
/// end of a loop, a chain of massless links that cannot be folded into one pair, an unknown signal,
/// an initial state that cannot be assembled, a motion without inertia.
std::shared_ptr<const CompiledSystem> make_system(const RobotDescription& robot, const Study& study,
                                                  Warnings* warnings = nullptr);

}  // namespace codesign
