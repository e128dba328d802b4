// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "description/signal.h"
#include "linear/linear_model.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/status.h"

namespace codesign {

class CompiledSystem;

/// A posture at rest: velocities and accelerations are zero.
struct Equilibrium {
  Status status;
  FrameNames names;
  Frame frame;                    ///< at rest; after a failure the last posture that was tried
  LinearModel linear;             ///< small motions about it, with all that is counted
  State<double> state;            ///< at rest; q and turns count
  std::vector<double> integrals;  ///< the state of each controller's integral
  int steps = 0;
};

/// Searches the equilibrium to which a mechanism creeps from the start of its study: always along
/// its acceleration from rest; doc/theory.md (66). Functions of time keep their values at t = 0,
/// friction is zero, lags and filters have settled, sampled controllers hold the output that they
/// compute at rest, and controllers with an integral have no error, theory (66a). Its stability is
/// that of the closed loops, theory (67), (68).
/// @param system as make_system() compiled it; its duration is the time that decides what is
/// neutral. @param parameters all named parameters. @param signals of the frame.
/// @param question what to tell of small motions about it.
/// @param cancel once set, ends soon with kCancelled; nullptr: never.
/// @throws InputError for a signal that does not exist, for postures, and as linear_model().
/// Statuses: kNoEquilibrium, and those of DrivenMotion.
Equilibrium find_equilibrium(const CompiledSystem& system, const std::vector<double>& parameters,
                             const std::vector<SignalDescription>& signals,
                             const std::atomic<bool>* cancel = nullptr,
                             const LinearQuestion& question = {});

}  // namespace codesign
