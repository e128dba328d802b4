// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/loop_jacobian.h"
#include "assembly/start_design.h"
#include "assembly/tree_coordinates.h"
#include "math/scalar.h"
#include "system/state.h"
#include "system/tree_kinematics.h"

namespace codesign {

struct TreeLoops;

/// A position of the tree's joints with their rates, and what a start knows about it.
struct Posture {
  /// Relative rank tolerances of the scaled Jacobian of the loops. Parts below kRank come from
  /// rounded angles and lengths or from an almost singular position and are ignored; if the loops
  /// do not close without them, kSingularRank is tried.
  static constexpr double kRank = 1e-3, kSingularRank = 1e-9;

  VectorX<double> theta;  ///< [rad or m], TreeLayout order
  VectorX<double> rate;   ///< the derivative of theta by time
  GivenStart given;       ///< what is held, and what is guessed
  double number = 0.0;    ///< of the study's list of postures; between two on the way to the next
  double time = 0.0;      ///< of the motions that are given [s]
  double rank_tolerance = kRank;  ///< with which the loops were closed
  /// the largest closure error at theta; after a failure, at the nearest position that was tried
  LoopMiss miss;
  std::vector<int> dependent;  ///< coordinates that the loops determine
  /// coordinates that were changed to close the loops: these, or all that are not given
  std::vector<int> moved;
};

/// Whether two positions belong to one branch: they differ by no more than the accuracy of a
/// solution, relative to `theta`.
bool is_same_branch(const VectorX<double>& theta, const VectorX<double>& other);

/// Sets the coordinates, rates, turns of the tree's joints and signs of `state` from a posture.
/// @param links overwritten; its memory is used again.
void place(const TreeLoops& loops, const StartDesign& design, const Posture& posture,
           std::vector<LinkMotion<double>>* links, State<double>* state);

/// The motor behind an elastic gear starts with its joint: nothing is deflected.
void follow_gears(const TreeLayout& tree, Posture* posture);

}  // namespace codesign
