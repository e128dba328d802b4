// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/nearest_branch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "assembly/tree_loops.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kDescents = 60;
constexpr double kDescentTurn = 0.5;  // [rad or m] limit of one step on the way to a start
constexpr double kFlowTurn = 0.1;     // the same where the way is to follow Newton's flow
constexpr double kEnough = 1e-6;      // a shorter step of a descent ends it
constexpr double kNearer = 0.99;      // of the distance of the branch before
constexpr double kAtGuess = 1e-6;     // a distance that is none

/// The coordinates of loops that have a guess, ascending.
std::vector<int> guessed_coordinates(const TreeLoops& loops, const GivenStart& given) {
  std::vector<int> guessed;
  for (const int c : loops.jacobian.coordinates())
    if (const auto k = to_index(c); given.guess[k] && !given.position[k]) guessed.push_back(c);
  return guessed;
}

/// The guesses, and how far a position is from them.
struct Guesses {
  const VectorX<double>& start;
  std::vector<int> guessed;
  VectorX<double> levers;

  /// The root mean square of what the guessed coordinates have moved from their guesses, slides by
  /// their levers.
  double distance(const VectorX<double>& theta) const {
    double sum = 0.0;
    for (const int c : guessed) {
      const double moved = (theta[c] - start[c]) / levers[c];
      sum += moved * moved;
    }
    return std::sqrt(sum);
  }
};

/// A solution, and how far it closes.
struct Branch {
  Closure closure;
  Posture posture;
};

/// Changes `columns` so that the errors of the loops become smaller, by Gauss and Newton's method
/// with steps that are halved until they do; it ends at a least error, or where the loops close.
void descend(const TreeLoops& loops, const StartDesign& design, const std::vector<int>& columns,
             double most, Posture* posture) {
  VectorX<double>& theta = posture->theta;
  const LoopSearch search{columns, posture->rank_tolerance, LoopRows::kAll};
  LoopErrors errors;
  LoopStep newton;
  VectorX<double> from;
  for (int iteration = 0; iteration < kDescents && !columns.empty() && !design.cancelled();
       ++iteration) {
    if (!std::isfinite(errors.find(loops, design, LoopRows::kAll, posture))) return;
    const Eigen::VectorXd step = newton.find(loops, design, search, theta, errors.rows).col(0);
    const Eigen::VectorXd& weights = newton.loops.scales.rows;
    const auto size = [&] {
      return (weights.array() * errors.rows.col(0).array()).matrix().norm();
    };
    const double before = size(), longest = step.cwiseAbs().maxCoeff();
    from = theta;
    double part = longest > most ? most / longest : 1.0;
    bool descends = false;
    for (int halving = 0; halving < 8 && !descends; ++halving, part *= 0.5) {
      for (std::size_t k = 0; k < columns.size(); ++k)
        theta[columns[k]] = from[columns[k]] - part * step[to_signed(k)];
      descends =
          std::isfinite(errors.find(loops, design, LoopRows::kAll, posture)) && size() < before;
    }
    if (!descends) {
      theta = from;
      return;
    }
    if (part * longest < kEnough) return;
  }
}

}  // namespace

Closure take_nearest_branch(const TreeLoops& loops, const StartDesign& design, Closure plain,
                            const VectorX<double>& start, LoopClosure* closure, Posture* posture) {
  Guesses guesses{start, guessed_coordinates(loops, posture->given), {}};
  if (guesses.guessed.empty()) return plain;
  const bool closes = plain != Closure::kApart;
  if (!closes) posture->rank_tolerance = Posture::kSingularRank;
  Branch best{plain, *posture};
  posture->theta = start;
  ScaledLoops scaled;
  scaled.evaluate(loops, design, start, LoopRows::kAll);
  guesses.levers = scaled.scales.columns;
  const std::vector<int> free =
      closes ? posture->moved
             : closure->dependent(design, *posture, LoopRows::kAll, posture->rank_tolerance);
  std::vector<int> others;
  std::set_difference(free.begin(), free.end(), guesses.guessed.begin(), guesses.guessed.end(),
                      std::back_inserter(others));
  const bool is_regular =
      closes && closure->newton().converges_at_once(design, free, LoopRows::kAll, posture) &&
      is_same_branch(posture->theta, best.posture.theta);
  double nearest =
      closes ? guesses.distance(best.posture.theta) : std::numeric_limits<double>::infinity();
  const auto attempt = [&](const VectorX<double>& from, const std::vector<int>& columns,
                           double most) {
    if (design.cancelled()) return;
    posture->theta = from;
    descend(loops, design, columns, most, posture);
    const Closure found =
        closure->newton().solve(design, {free, posture->rank_tolerance, LoopRows::kAll}, posture);
    if (found == Closure::kApart || found > best.closure) return;
    const double distance = guesses.distance(posture->theta);
    if (!(distance < kNearer * nearest) || is_same_branch(posture->theta, best.posture.theta))
      return;
    nearest = distance;
    best = {found, *posture};
    best.posture.moved = free;
  };
  if (!is_regular && !(nearest < kAtGuess)) {
    VectorX<double> other = best.posture.theta;
    for (const int c : guesses.guessed) other[c] = start[c];
    const VectorX<double> mirrored = 2.0 * other - best.posture.theta;
    if (closes) attempt(other, others, kDescentTurn);
    attempt(start, others, kDescentTurn);
    attempt(start, free, kFlowTurn);
    if (closes) attempt(mirrored, {}, kDescentTurn);
  }
  *posture = best.posture;
  return best.closure;
}

}  // namespace codesign
