// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_positions.h"

#include "assembly/guess_text.h"
#include "assembly/nearest_branch.h"
#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kNudge = 0.01;  // [rad], or this part of the loop's longest lever

Status closure_failed(const StartDesign& design, const LoopMiss& miss) {
  if (design.cancelled()) return {StatusCode::kCancelled, 0.0, "cancelled"};
  return {StatusCode::kAssemblyFailed, 0.0,
          "loop or coupling '" + std::string(miss.owner) +
              "' cannot be closed from the given initial state"};
}

/// The coordinates along the loops that have neither position nor guess and follow no others.
std::vector<int> open_coordinates(const TreeLoops& loops, const GivenStart& given) {
  std::vector<int> open;
  for (const int c : loops.jacobian.coordinates())
    if (const auto k = to_index(c);
        !given.position[k] && !given.guess[k] && !loops.followers.follows(c))
      open.push_back(c);
  return open;
}

}  // namespace

/// Tries small guesses: all joints in one direction, every other one in the opposite direction,
/// every other pair. kApart leaves `posture` as it was.
Closure StartPositions::nudge(const StartDesign& design, FirstPosture* first, Posture* posture,
                              Warnings* warnings) {
  const VectorX<double> start = start_, apart = posture->theta;
  const LoopMiss miss = posture->miss;
  ScaledLoops scaled;
  scaled.evaluate(loops_, design, start, LoopRows::kAll);
  const std::vector<int> open = open_coordinates(loops_, posture->given);
  for (unsigned period = 0; period < 3 && !open.empty() && !design.cancelled(); ++period) {
    VectorX<double> nudge = VectorX<double>::Zero(loops_.tree.size);
    for (std::size_t k = 0; k < open.size(); ++k)
      nudge[open[k]] =
          kNudge * scaled.scales.columns[open[k]] * ((k * period / 2) % 2 == 0 ? 1.0 : -1.0);
    posture->theta = start + nudge;
    loops_.followers.follow(*design.equations, posture);
    const Closure closure = closure_.close(design, posture);
    if (closure == Closure::kApart) continue;
    warnings->push_back(
        {"guessed_start",
         "loop or coupling '" + std::string(miss.owner) +
             "' cannot be closed from the start values, where its joints may be stretched " +
             "out in a line: small guesses were tried, and in which direction it bends is "
             "arbitrary; to choose it, write initial_state: {" +
             guess_text(loops_.system.robot(), loops_.tree, nudge, open) +
             "}, with other signs for another direction",
         {}});
    first->nudge(nudge);
    return closure;
  }
  posture->theta = apart;
  posture->miss = miss;
  return Closure::kApart;
}

Closure StartPositions::close_or_nudge(const StartDesign& design, FirstPosture* first,
                                       Posture* posture, Warnings* warnings) {
  const bool is_own = first->is_own(design.parameters);
  start_ = posture->theta;
  Closure plain = closure_.close(design, posture);
  if (plain == Closure::kApart || is_own)
    plain = take_nearest_branch(loops_, design, plain, start_, &closure_, posture);
  if (plain != Closure::kApart || !is_own || first->nudge().size() > 0) return plain;
  return nudge(design, first, posture, warnings);
}

Status StartPositions::find(const StartDesign& design, FirstPosture* first, Posture* posture,
                            Warnings* warnings) {
  if (close_or_nudge(design, first, posture, warnings) == Closure::kApart)
    return closure_failed(design, posture->miss);
  if (!loops_.system.sharing().drops()) return {};
  // Now the enforced rows alone, to rounding: the integrators start from Phi = 0 in these rows.
  const LoopMiss miss = posture->miss;
  posture->dependent =
      closure_.dependent(design, *posture, LoopRows::kEnforced, posture->rank_tolerance);
  const LoopSearch search{posture->dependent, posture->rank_tolerance, LoopRows::kEnforced};
  if (closure_.newton().solve(design, search, posture) != Closure::kClosed ||
      !closure_.newton().is_near(posture->miss)) {
    posture->miss = miss;
    return closure_failed(design, miss);
  }
  return {};
}

}  // namespace codesign
