// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "control/control_clock.h"
#include "integration/rosenbrock_integrator.h"
#include "math/arrays.h"

namespace codesign {

/// What happens between two steps of a run, theory (17d), (52): a change of the mode, events of
/// sampled controllers, or both.
struct RunJump {
  int point = 0;                     ///< number of steps before it
  std::vector<bool> mode;            ///< that the equations hold after it; empty without switches
  std::vector<ControlEvent> events;  ///< of sampled controllers, in turn
  /// The guard whose zero determines its instant, in the mode before it; -1 if none does.
  int guard = -1;
  double guard_rate = 0.0;      ///< s_t + s_x f- of the guard [per s]
  VectorX<double> rates;        ///< z- - z+ of both modes, (18g); with a guard only
  double integrand_jump = 0.0;  ///< g- - g+; with a guard only
};

/// A change of the mode alone, without events. @param point number of steps before it.
RunJump run_jump(int point, const ModeChange& change);

/// The jumps of a run in order of time, for the backward pass of the adjoint. clear() keeps the
/// memory for the next run.
class RunJumps {
 public:
  void clear() { count_ = 0; }
  bool is_empty() const { return count_ == 0; }
  /// Appends the last jump of an integrator, has_jumped(). @param point number of steps before it.
  void append(int point, const RosenbrockIntegrator& run);

  /// The jump behind step number `point`; null if there is none.
  const RunJump* at(int point) const;
  /// The mode that the equations hold before and after the instant of a point; empty before the
  /// first jump, where each state decides.
  const std::vector<bool>& mode_before(int point) const { return mode_of_first(after(point - 1)); }
  const std::vector<bool>& mode_after(int point) const { return mode_of_first(after(point)); }

 private:
  /// How many jumps there are up to a point.
  std::size_t after(int point) const;
  const std::vector<bool>& mode_of_first(std::size_t jumps) const {
    return jumps > 0 ? jumps_[jumps - 1].mode : none_;
  }

  std::vector<RunJump> jumps_;  ///< the first `count_` entries; the others are spare memory
  std::size_t count_ = 0;
  std::vector<bool> none_;  ///< stays empty
};

}  // namespace codesign
