// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "assembly/assembly.h"
#include "integration/one_step.h"
#include "integration/rosenbrock_integrator.h"
#include "sensitivity/run_jumps.h"
#include "sensitivity/step_path.h"

namespace codesign {

/// The steps of a run and the jumps between them, stored forward and repeated from the last one to
/// the first, for the backward pass of the adjoint, doc/theory.md (18a). Point k is where step k
/// ended; point 0 is the start.
class StepReplay {
 public:
  /// @param most_points stored points of the path, see StepPath.
  StepReplay(const CompiledSystem& system, const RosenbrockTableau& tableau, int most_points);

  /// Forgets the last run and stores the start of this one.
  void start(const RosenbrockIntegrator& run);
  /// Stores the last step of the run, or its last jump, in the order in which they happen.
  void store_step(const RosenbrockIntegrator& run);
  void store_jump(const RosenbrockIntegrator& run);

  /// Number of points.
  int size() const { return path_.size(); }
  /// Prepares repetitions. @param run that was stored; its assembly solves for rates behind jumps.
  void begin(RosenbrockIntegrator* run);
  /// Goes to point k, at most the point of the last call, and over the jump there, and attempts the
  /// step that follows, if there is one. False if cancelled or if something cannot be repeated.
  bool repeat(int k, const std::atomic<bool>* cancel);

  /// The step after repeat().
  OneStep<double>& step() { return step_; }
  /// The unprojected end of step k.
  const State<double>& point() const { return point_; }
  /// The jump at point k, with the states before and behind it; null if there is none.
  const RunJump* jump(int k) const { return jumps_.at(k); }
  const State<double>& before() const { return before_; }
  const State<double>& behind() const { return behind_; }
  /// The mode of the step that ended at point k, and of the one that begins there.
  const std::vector<bool>& mode_before(int k) const { return jumps_.mode_before(k); }
  const std::vector<bool>& mode_after(int k) const { return jumps_.mode_after(k); }

 private:
  bool reach(int k, const std::atomic<bool>* cancel);
  bool take_up(int k);
  bool carry_over(const RunJump& jump);

  OneStep<double> step_;
  StepPath path_;
  RunJumps jumps_;
  Assembly* assembly_ = nullptr;
  bool has_pivots_ = false;
  State<double> point_, before_, behind_;
};

}  // namespace codesign
