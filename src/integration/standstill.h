// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_STANDSTILL_H_
#define MECHANISM_CODESIGN_INTEGRATION_STANDSTILL_H_

#include "equations/equations.h"
#include "mechanism_codesign/simulation.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// What the end of a step means for a run that comes to rest, in steps ever shorter, before a singular position; doc/theory.md (17c).
///
/// Reactions grow there as one over the smallest singular value of Phi_q, and friction that rests on them with them. Only mechanisms whose
/// redundant rows are dropped are looked at, since elsewhere the compliance leads past such positions, and only runs that failed or that
/// get along very slowly, so that others pay nothing.
/// @param initial where the run began. @param state at the end of the last step, which was `step_size` [s] long.
/// @returns `status`, or kSingularConfiguration in place of a failure at a singular position, and of success where the steps get so short
/// before one that the study would never end.
Status judge_standstill(const Status& status, const CompiledSystem& system, const State<double>& initial, const State<double>& state,
                        double step_size, const Statistics& statistics, Equations<double>* equations);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_STANDSTILL_H_
