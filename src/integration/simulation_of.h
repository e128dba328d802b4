// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "description/signal.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// A run of a compiled system.
/// @param parameters values of all named parameters. @param signals to sample into Frame::signals.
/// @throws InputError for a signal that does not exist or cannot be read.
Simulation simulation_of(std::shared_ptr<const CompiledSystem> system,
                         const std::vector<double>& parameters,
                         const std::vector<SignalDescription>& signals = {});

/// Finds where a run ends that has just started, and starts it again if it had to be computed for
/// that. @param end [s]: not beyond this; then where it ends.
Status find_end(Simulation* simulation, double* end);

}  // namespace codesign
