// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/loop_errors.h"
#include "assembly/posture.h"
#include "assembly/scaled_loops.h"
#include "assembly/start_design.h"

namespace codesign {

struct TreeLoops;

/// How far the loops and couplings are closed: to rounding, within solver.closure_tolerance, or
/// neither.
enum class Closure { kClosed, kNear, kApart };

/// Newton's method (19) for coordinates of a posture with which the loops close. Not thread-safe.
class LoopNewton {
 public:
  /// @param loops must outlive this.
  explicit LoopNewton(const TreeLoops& loops) : loops_(loops) {}

  /// From posture->theta, with steps of no more than 0.5 rad or m per coordinate. posture->miss is
  /// that of the last position, for kApart that of the nearest one.
  Closure solve(const StartDesign& design, const LoopSearch& search, Posture* posture);
  /// The same with full steps. True if they contract from the first one on, as they do in the
  /// neighbourhood of a regular solution only. @param posture its rank tolerance counts. @param
  /// free the coordinates that are changed.
  bool converges_at_once(const StartDesign& design, const std::vector<int>& free, LoopRows heeded,
                         Posture* posture);
  /// Whether a closure error is within solver.closure_tolerance.
  bool is_near(const LoopMiss& miss) const;

 private:
  double largest_turn(const std::vector<int>& free, const Eigen::MatrixXd& step) const;

  const TreeLoops& loops_;
  LoopErrors errors_;
  LoopStep step_;
};

}  // namespace codesign
