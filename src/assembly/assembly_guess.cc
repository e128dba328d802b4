// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Assembly that finds, of several branches, the one nearest to the study's guesses,
// doc/theory.md (19c).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr int kDescents = 60;
constexpr double kDescentTurn = 0.5;  // [rad or m] limit of one step on the way to a start
constexpr double kFlowTurn = 0.1;     // the same where the way is to follow Newton's flow
constexpr double kEnough = 1e-6;      // a shorter step of a descent ends it
constexpr double kNearer = 0.99;      // of the distance of the branch before
constexpr double kAtGuess = 1e-6;     // a distance that is none

}  // namespace

/// The root mean square of what the guessed coordinates have moved from their guesses, slides by
/// their levers.
double Assembly::distance_from(const VectorX<double>& start, const std::vector<int>& guessed,
                               const VectorX<double>& levers) const {
  double sum = 0.0;
  for (const int c : guessed) {
    const double moved = (theta_[c] - start[c]) / levers[c];
    sum += moved * moved;
  }
  return std::sqrt(sum);
}

/// Changes `columns` so that the errors of the loops become smaller, by Gauss and Newton's method
/// with steps that are halved until they do; it ends at a least error, or where the loops close.
void Assembly::descend(const std::vector<double>& parameters, Equations<double>* equations,
                       const std::vector<int>& columns, double most) {
  VectorX<double> from;
  Eigen::VectorXd step;
  for (int iteration = 0; iteration < kDescents && !columns.empty() && !cancelled(); ++iteration) {
    if (!std::isfinite(find_errors(parameters, equations))) return;
    step = newton_step(parameters, *equations, columns, rank_tolerance_).col(0);
    const Eigen::VectorXd weights = work_.loops.scales.rows;
    const auto size = [&] { return (weights.array() * work_.rows.col(0).array()).matrix().norm(); };
    const double before = size(), longest = step.cwiseAbs().maxCoeff();
    from = theta_;
    double part = longest > most ? most / longest : 1.0;
    bool descends = false;
    for (int halving = 0; halving < 8 && !descends; ++halving, part *= 0.5) {
      for (std::size_t k = 0; k < columns.size(); ++k)
        theta_[columns[k]] = from[columns[k]] - part * step[to_signed(k)];
      descends = std::isfinite(find_errors(parameters, equations)) && size() < before;
    }
    if (!descends) {
      theta_ = from;
      return;
    }
    if (part * longest < kEnough) return;
  }
}

/// The coordinates of loops that have a guess, ascending.
std::vector<int> Assembly::guessed_coordinates() const {
  std::vector<int> guessed;
  for (const int c : loops_.coordinates())
    if (const auto k = to_index(c); guess_given_[k] && !position_given_[k]) guessed.push_back(c);
  return guessed;
}

/// Of the branches that are found from starts near the guesses, the one nearest to them takes the
/// place of the solution of Newton's method, `plain`, which may be a far one: near a dead centre,
/// and where other coordinates have no guess. Coordinates that the loops do not determine stay.
Assembly::Closure Assembly::nearest_to_guess(Closure plain, const std::vector<double>& parameters,
                                             Equations<double>* equations) {
  const VectorX<double> start = work_.start;
  const std::vector<int> guessed = guessed_coordinates();
  if (guessed.empty()) return plain;
  struct Branch {
    Closure closure;
    VectorX<double> theta;
    std::vector<int> moved;
    double rank_tolerance;
    LoopMiss miss;
  };
  Branch best{plain, theta_, work_.moved, rank_tolerance_, worst_miss_};
  const bool closes = plain != Closure::kApart;
  theta_ = start;
  if (!closes) rank_tolerance_ = best.rank_tolerance = kSingularRank;
  scale_loops(parameters, *equations);
  const VectorX<double> levers = work_.loops.scales.columns;
  std::vector<int> free = best.moved;
  if (!closes) {
    prefer_positions();
    free = choose_columns(work_.positions);
  }
  std::vector<int> others;
  std::set_difference(free.begin(), free.end(), guessed.begin(), guessed.end(),
                      std::back_inserter(others));
  const bool is_regular =
      closes && converges_at_once(parameters, free, equations) && is_same(best.theta);
  theta_ = best.theta;
  double nearest =
      closes ? distance_from(start, guessed, levers) : std::numeric_limits<double>::infinity();
  const bool is_near = is_regular || nearest < kAtGuess;
  const auto attempt = [&](const VectorX<double>& from, const std::vector<int>& columns,
                           double most) {
    if (cancelled()) return;
    theta_ = from;
    rank_tolerance_ = best.rank_tolerance;
    descend(parameters, equations, columns, most);
    const Closure closure = newton(parameters, equations, free, best.rank_tolerance);
    if (closure == Closure::kApart || closure > best.closure) return;
    const double distance = distance_from(start, guessed, levers);
    if (!(distance < kNearer * nearest) || is_same(best.theta)) return;
    nearest = distance;
    best = {closure, theta_, free, best.rank_tolerance, worst_miss_};
  };
  if (!is_near) {
    VectorX<double> other = best.theta;
    for (const int c : guessed) other[c] = start[c];
    const VectorX<double> mirrored = 2.0 * other - best.theta;
    if (closes) attempt(other, others, kDescentTurn);
    attempt(start, others, kDescentTurn);
    attempt(start, free, kFlowTurn);
    if (closes) attempt(mirrored, {}, kDescentTurn);
  }
  theta_ = best.theta;
  work_.moved = best.moved;
  rank_tolerance_ = best.rank_tolerance;
  worst_miss_ = best.miss;
  return best.closure;
}

}  // namespace codesign
