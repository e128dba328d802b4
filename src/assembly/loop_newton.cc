// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

// A loop error below this times the mechanism's size counts as closed.
constexpr double kClosed = 1e-12;
// A Newton step [rad or m] below this times the mechanism's size counts as zero.
constexpr double kAtRest = 1e-13;
constexpr int kNewtonIterations = 200;
// [rad or m] limit of one Newton step per coordinate, so that the solution stays on the start's
// branch.
constexpr double kLargestTurn = 0.5;
// Of Newton steps; with less contraction the solution nearest to the start of the iteration is
// found.
constexpr double kContraction = 0.25;
// [rad or m] limit of the first step per coordinate of steps that contract.
constexpr double kFirstTurn = 0.5;
constexpr int kMostCorrections = 12;

}  // namespace

/// The largest change but those of followers of couplings: a coupling is linear and has no
/// branches.
double LoopNewton::largest_turn(const std::vector<int>& free, const Eigen::MatrixXd& step) const {
  double largest = 0.0;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (!loops_.followers.follows(free[k]))
      largest = std::max(largest, std::abs(step(to_signed(k), 0)));
  return largest;
}

bool LoopNewton::is_near(const LoopMiss& miss) const {
  const double tolerance = loops_.system.study().solver.closure_tolerance;
  return miss.length <= tolerance && miss.angle <= tolerance;
}

Closure LoopNewton::solve(const StartDesign& design, const LoopSearch& search, Posture* posture) {
  VectorX<double>& theta = posture->theta;
  double previous = std::numeric_limits<double>::infinity(), closed = kClosed;
  LoopMiss nearest{"", previous, previous};
  for (int iteration = 0; iteration < kNewtonIterations; ++iteration) {
    if (design.cancelled()) return Closure::kApart;
    const double error = errors_.find(loops_, design, search.heeded, posture);
    if (!std::isfinite(error)) return Closure::kApart;
    if (size_of(posture->miss) < size_of(nearest)) nearest = posture->miss;
    // Converged when rounding stops the quadratic decrease.
    const double size = 1.0 + theta.cwiseAbs().maxCoeff();
    closed = kClosed * size;
    if (error == 0.0 || (error < closed && error >= 0.5 * previous)) return Closure::kClosed;
    previous = error;
    const Eigen::MatrixXd& step = step_.find(loops_, design, search, theta, errors_.rows);
    const double largest = largest_turn(search.free, step),
                 shortened = largest > kLargestTurn ? kLargestTurn / largest : 1.0;
    for (std::size_t k = 0; k < search.free.size(); ++k)
      theta[search.free[k]] -= shortened * step(to_signed(k), 0);
    if (step.size() == 0 || (error >= closed && step.cwiseAbs().maxCoeff() < kAtRest * size)) break;
  }
  if (previous < closed) return Closure::kClosed;
  if (is_near(posture->miss)) return Closure::kNear;
  posture->miss = nearest;
  return Closure::kApart;
}

bool LoopNewton::converges_at_once(const StartDesign& design, const std::vector<int>& free,
                                   LoopRows heeded, Posture* posture) {
  VectorX<double>& theta = posture->theta;
  const LoopSearch search{free, posture->rank_tolerance, heeded};
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostCorrections && !design.cancelled(); ++iteration) {
    const double error = errors_.find(loops_, design, heeded, posture),
                 size = 1.0 + theta.cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return false;
    if (error == 0.0) return true;
    const Eigen::MatrixXd& step = step_.find(loops_, design, search, theta, errors_.rows);
    const double turn = largest_turn(free, step),
                 change = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
    if (!(turn <= kFirstTurn)) return false;
    if (change <= kAtRest * size || change > kContraction * previous) return error < kClosed * size;
    for (std::size_t k = 0; k < free.size(); ++k) theta[free[k]] -= step(to_signed(k), 0);
    previous = change;
  }
  return false;
}

}  // namespace codesign
