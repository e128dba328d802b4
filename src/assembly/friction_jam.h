// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "system/state.h"

namespace codesign {

class CompiledSystem;
template <class T>
class Equations;

/// The joints and loops whose friction grows with their reactions, and that slide; if none of them
/// slides, all of them: 'a', 'b'. Empty if the mechanism has none. @param equations must hold the
/// design.
std::string rubbing_joints(const CompiledSystem& system, const State<double>& state,
                           Equations<double>* equations);

/// Why friction may leave no solution, and what helps, to be added to a sentence; empty without
/// such joints. Where friction grows faster with a reaction than the reaction does with it, no
/// accelerations and reactions satisfy the equations of motion (Painleve's paradox).
std::string jam_advice(const CompiledSystem& system, const State<double>& state,
                       Equations<double>* equations);

}  // namespace codesign
