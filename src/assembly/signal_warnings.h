// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/redundancy.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// `undetermined_reaction` for each signal that reads a component of a reaction that is not unique.
/// @param state the state at which `redundancy` was found. @param equations must hold its design.
Warnings warn_of_open_reactions(const CompiledSystem& system, const Redundancy& redundancy, const State<double>& state,
                                const std::vector<SignalDescription>& signals, Equations<double>* equations);

/// The same for signals that are not in the study, at the start of a compiled system at its own parameters. None if the positions of the
/// start cannot be found.
Warnings warn_of_open_reactions(const CompiledSystem& system, const std::vector<SignalDescription>& signals);

}  // namespace codesign
