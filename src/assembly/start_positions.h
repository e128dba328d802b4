// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/first_posture.h"
#include "assembly/loop_closure.h"
#include "assembly/posture.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "mechanism_codesign/status.h"

namespace codesign {

struct TreeLoops;

/// The positions of a start: a closed posture from one that is not closed, doc/theory.md (19),
/// (19c). Not thread-safe.
class StartPositions {
 public:
  /// @param loops, closure must outlive this.
  StartPositions(const TreeLoops& loops, LoopClosure* closure)
      : loops_(loops), closure_(*closure) {}

  /// First every row of the loops and couplings counts, dropped ones too; if the system drops rows,
  /// the enforced rows are then solved to rounding.
  /// @param first whose nudge is set if a start of the study itself closes with it only, which a
  /// warning `guessed_start` says. @param posture to begin from, replaced by the closed one.
  /// @returns kAssemblyFailed, kCancelled.
  Status find(const StartDesign& design, FirstPosture* first, Posture* posture, Warnings* warnings);

 private:
  Closure close_or_nudge(const StartDesign& design, FirstPosture* first, Posture* posture,
                         Warnings* warnings);
  Closure nudge(const StartDesign& design, FirstPosture* first, Posture* posture,
                Warnings* warnings);

  const TreeLoops& loops_;
  LoopClosure& closure_;
  VectorX<double> start_;  ///< the coordinates that find() began from
};

}  // namespace codesign
