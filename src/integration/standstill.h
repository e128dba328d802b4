// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/equations.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Detects a run that stalls, with ever shorter steps, before a singular position; doc/theory.md (17c). To be called after each step.
///
/// Near such a position reactions grow as one over the smallest singular value of Phi_q, and so does friction that depends on them. Only
/// mechanisms with dropped redundant rows are checked, since otherwise the compliance leads past the position. Of their runs, only those
/// that failed or whose steps are very short are checked, so that other runs cost nothing.
/// @param status of the step. @param initial state of the run. @param state at the end of the last step. @param step_size its size [s].
/// @param equations must hold the design.
/// @returns kSingularConfiguration, with rank and joints in its cause, if the run is at a singular position and either failed there or
/// would need more than 20,000 further steps; else `status`.
Status judge_standstill(const Status& status, const CompiledSystem& system, const State<double>& initial, const State<double>& state,
                        double step_size, const Statistics& statistics, Equations<double>* equations);

}  // namespace codesign
