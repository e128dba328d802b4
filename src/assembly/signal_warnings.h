// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_SIGNAL_WARNINGS_H_
#define MECHANISM_CODESIGN_ASSEMBLY_SIGNAL_WARNINGS_H_

#include <vector>

#include "assembly/redundancy.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

/// Warns of each signal that reads a reaction which nothing determines. @param state of the redundancy.
Warnings warn_of_open_reactions(const CompiledSystem& system, const Redundancy& redundancy, const State<double>& state,
                                const std::vector<SignalDescription>& signals, Equations<double>* equations);

/// The same at the start of a system that is compiled already, of signals beside the study's.
Warnings warn_of_open_reactions(const CompiledSystem& system, const std::vector<SignalDescription>& signals);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_SIGNAL_WARNINGS_H_
