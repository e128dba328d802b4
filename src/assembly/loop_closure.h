// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/loop_newton.h"
#include "assembly/posture.h"
#include "assembly/scaled_loops.h"
#include "assembly/start_design.h"
#include "math/scalar.h"
#include "sparse/least_squares.h"

namespace codesign {

struct TreeLoops;

/// Closes the loops from a posture by Newton's method (19), in which all rows count: it chooses the
/// coordinates that change and the rank tolerance. Not thread-safe.
class LoopClosure {
 public:
  /// @param loops must outlive this.
  explicit LoopClosure(const TreeLoops& loops) : loops_(loops), newton_(loops) {}

  /// From posture->theta with Posture::kRank, else with kSingularRank. Sets the coordinates of the
  /// posture, its rank tolerance, miss, and which coordinates are dependent and were moved.
  Closure close(const StartDesign& design, Posture* posture);

  /// The coordinates that the loops determine at a posture, of those whose positions are not given.
  /// Open positions close the loops together, by the least change: one of them alone may bring its
  /// loop to a dead centre. @param rank_tolerance relative. @returns coordinates, ascending; valid
  /// until the next call.
  const std::vector<int>& dependent(const StartDesign& design, const Posture& posture,
                                    LoopRows heeded, double rank_tolerance);
  LoopNewton& newton() { return newton_; }

 private:
  Closure close_within(const StartDesign& design, double rank_tolerance, Posture* posture);
  void refine(const StartDesign& design, Posture* posture);

  const TreeLoops& loops_;
  LoopNewton newton_;
  ScaledLoops scaled_;
  IndependentColumns independent_;
  ColumnPreferences preferences_;
  /// coordinates to return to, of close(), close_within() and refine()
  VectorX<double> start_, first_, near_;
};

}  // namespace codesign
