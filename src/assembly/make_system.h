// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_MAKE_SYSTEM_H_
#define MECHANISM_CODESIGN_ASSEMBLY_MAKE_SYSTEM_H_

#include <memory>

#include "description/robot.h"
#include "description/study.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Compiles a mechanism and a study into equations of motion. Assembles the start and handles redundant constraints there, doc/theory.md
/// (23).
/// @param warnings receives `inexact_loop`, `undetermined_friction` and `undetermined_reaction`, if not null.
/// @throws InputError for a mechanism without equations of motion: two masses on one loop end, a massless chain that cannot be folded, an
/// unknown signal, a start that cannot be assembled, a motion without inertia.
std::shared_ptr<const CompiledSystem> make_system(const RobotDescription& robot, const Study& study, Warnings* warnings = nullptr);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_MAKE_SYSTEM_H_
