// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "equations/turn_follower.h"
#include "math/scalar.h"
#include "system/state.h"

namespace codesign {

struct TreeLoops;

/// Sets the turns of loops in `state`, which do not follow from the tree's coordinates, to those of
/// `turns` (State::turns).
void keep_loop_turns(const System& system, const std::vector<double>& turns, State<double>* state);

/// Carries the turns of loops from `state`, at the coordinates `from`, to a posture, and places the
/// state there: along the line between both, in parts so short that no body turns by half a turn.
/// @param follower of this system.
void count_turns(const TreeLoops& loops, const StartDesign& design, const VectorX<double>& from,
                 const Posture& to, TurnFollower<double>* follower, State<double>* state);

}  // namespace codesign
