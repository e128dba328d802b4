// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <complex>
#include <string>
#include <vector>

#include "description/signal.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/status.h"

namespace codesign {

class CompiledSystem;

/// A small free motion about an equilibrium, without friction and damping: y = exp(mu t), theory
/// (66).
struct EquilibriumMode {
  std::complex<double> square;  ///< mu^2 [1/s^2]: negative for an oscillation
  /// Rates of FrameNames::joints in this motion, the largest one 1; all zero if no joint with one
  /// coordinate takes part.
  std::vector<double> rates;

  double growth() const;     ///< Re mu >= 0 [1/s]
  double frequency() const;  ///< |Im mu|/(2 pi) [Hz]
};

/// What becomes of a small disturbance: it stays small, it grows, or a motion without force leads
/// away.
enum class Stability { kStable, kUnstable, kNeutral };
/// "stable", "unstable", "neutral".
const char* name_of(Stability stability);

/// A posture at rest: velocities and accelerations are zero.
struct Equilibrium {
  Status status;
  FrameNames names;
  Frame frame;  ///< at rest; after a failure the last posture that was tried
  Stability stability = Stability::kStable;
  std::vector<EquilibriumMode> modes;  ///< the least stable one first
  int steps = 0;
};

/// Searches the equilibrium to which a mechanism creeps from the start of its study: always along
/// its acceleration from rest; doc/theory.md (66). Functions of time keep their values at t = 0,
/// friction is zero, lags and filters have settled, sampled controllers hold the output that they
/// compute at rest.
/// @param system as make_system() compiled it; its duration is the time that decides what is
/// neutral. @param parameters all named parameters. @param signals of the frame.
/// @param cancel once set, ends soon with kCancelled; nullptr: never.
/// @throws InputError for a controller with an integral, whose error, not its output, would have to
/// vanish, and for a signal that does not exist. Statuses: kNoEquilibrium, and those of
/// DrivenMotion.
Equilibrium find_equilibrium(const CompiledSystem& system, const std::vector<double>& parameters,
                             const std::vector<SignalDescription>& signals,
                             const std::atomic<bool>* cancel = nullptr);

}  // namespace codesign
