// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/loop_closure.h"
#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "math/scalar.h"

namespace codesign {

struct TreeLoops;

/// Of the branches that are found from starts near the guesses, the one nearest to them takes the
/// place of a solution of Newton's method, which may be a far one: near a dead centre, and where
/// other coordinates have no guess; doc/theory.md (19c). Coordinates that the loops do not
/// determine stay.
/// @param plain how far that solution, `posture`, closes. @param start the guesses it was found
/// from [rad or m], TreeLayout order. @returns how far `posture` closes then.
Closure take_nearest_branch(const TreeLoops& loops, const StartDesign& design, Closure plain,
                            const VectorX<double>& start, LoopClosure* closure, Posture* posture);

}  // namespace codesign
