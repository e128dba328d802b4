// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_closure.h"

#include <algorithm>

#include "assembly/tree_loops.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// [rad or m] two positions that differ by less are taken as the same.
constexpr double kSamePlace = 0.05;

}  // namespace

const std::vector<int>& LoopClosure::dependent(const StartDesign& design, const Posture& posture,
                                               LoopRows heeded, double rank_tolerance) {
  loops_.followers.by_preference(posture.given.position, &preferences_);
  scaled_.evaluate(loops_, design, posture.theta, heeded);
  return independent_.choose(scaled_.matrix, preferences_, rank_tolerance);
}

// If changing the dependent coordinates alone does not close the loops, the start may be singular
// (a stretched-out linkage): then all coordinates without a given position are changed.
Closure LoopClosure::close_within(const StartDesign& design, double rank_tolerance,
                                  Posture* posture) {
  first_ = posture->theta;
  posture->rank_tolerance = rank_tolerance;
  posture->dependent = dependent(design, *posture, LoopRows::kAll, rank_tolerance);
  posture->moved = posture->dependent;
  const Closure closure =
      newton_.solve(design, {posture->moved, rank_tolerance, LoopRows::kAll}, posture);
  if (closure != Closure::kApart) return closure;
  const LoopMiss miss = posture->miss;
  posture->theta = first_;
  posture->moved.clear();
  for (int c = 0; c < loops_.tree.size; ++c)
    if (!posture->given.position[to_index(c)]) posture->moved.push_back(c);
  const Closure second =
      newton_.solve(design, {posture->moved, rank_tolerance, LoopRows::kAll}, posture);
  if (second == Closure::kApart && size_of(miss) < size_of(posture->miss)) posture->miss = miss;
  return second;
}

// A position within the tolerance but not closed may be almost singular, with an exactly closed
// position nearby: it is taken if found.
void LoopClosure::refine(const StartDesign& design, Posture* posture) {
  near_ = posture->theta;
  const LoopMiss miss = posture->miss;
  const bool closes = close_within(design, Posture::kSingularRank, posture) == Closure::kClosed;
  if (closes && (posture->theta - near_).cwiseAbs().maxCoeff() < kSamePlace) return;
  posture->theta = near_;
  posture->miss = miss;
  posture->rank_tolerance = Posture::kRank;
}

Closure LoopClosure::close(const StartDesign& design, Posture* posture) {
  start_ = posture->theta;
  Closure closure = close_within(design, Posture::kRank, posture);
  if (closure == Closure::kNear) refine(design, posture);
  if (closure != Closure::kApart) return closure;
  const LoopMiss miss = posture->miss;
  posture->theta = start_;
  closure = close_within(design, Posture::kSingularRank, posture);
  if (closure == Closure::kApart && size_of(miss) < size_of(posture->miss)) posture->miss = miss;
  return closure;
}

}  // namespace codesign
