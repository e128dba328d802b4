// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/posture.h"
#include "assembly/singular_start.h"
#include "assembly/start_design.h"
#include "mechanism_codesign/status.h"
#include "system/state.h"

namespace codesign {

struct TreeLoops;

/// At a singular position where several motions meet, rates can satisfy the loops to first order
/// without belonging to any motion, doc/theory.md (19a): then those that are not given are changed.
/// @param singular receives the posture. @param warnings receives `singular_start` if one of
/// several motions was chosen. @returns kSingularConfiguration if the given rates belong to none.
Status choose_motion(const TreeLoops& loops, const StartDesign& design, Posture* posture,
                     SingularStart* singular, Warnings* warnings);

/// From rest, the accelerations take the place of the velocities in this check.
/// @param state with its accelerations. @param singular as choose_motion() left it.
/// @returns kSingularConfiguration if the accelerations belong to no motion.
Status require_motion(const TreeLoops& loops, const Posture& posture, const State<double>& state,
                      SingularStart* singular);

}  // namespace codesign
