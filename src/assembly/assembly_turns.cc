// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that count the turns of loops from one position to another.
#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kPartOfTurn = 3.0;  // [rad or m] of all coordinates together

}  // namespace

/// The turns of loops, which do not follow from the tree's coordinates.
void Assembly::keep_loop_turns(const std::vector<double>& turns, State<double>* state) const {
  for (std::size_t p = 0; p < system_.topology().pairs.size(); ++p) {
    if (!system_.topology().pairs[p].is_loop) continue;
    for (std::size_t e = 0; e < system_.topology().pairs[p].chain.size(); ++e) {
      const auto slot = to_index(system_.layout().turn(static_cast<int>(p), static_cast<int>(e)));
      state->turns[slot] = turns[slot];
    }
  }
}

/// Carries the turns of loops from `state`, at the coordinates `from`, to theta_, and places it
/// there: along the line between both, in parts so short that no body turns by half a turn.
void Assembly::count_turns(const VectorX<double>& from, const std::vector<double>& parameters,
                           Equations<double>* equations, TurnFollower<double>* turns,
                           State<double>* state) {
  const VectorX<double> to = theta_;
  const int parts = 1 + static_cast<int>((to - from).cwiseAbs().sum() / kPartOfTurn);
  State<double> before = *state;
  for (int part = 1; part <= parts; ++part) {
    theta_ = part == parts ? to : VectorX<double>(from + (to - from) * part / parts);
    place(parameters, equations, state);
    // Of a free body, p and -p are the same position; the way between both states has to be short.
    for (int b = 0; b < system_.layout().bodies; ++b) {
      if (!system_.layout().is_free(b)) continue;
      auto p = state->q.segment<4>(system_.layout().column(b) + 3);
      if (p.dot(before.q.segment<4>(system_.layout().column(b) + 3)) < 0.0) p *= -1.0;
    }
    const std::vector<double> of_tree = state->turns;
    turns->follow(before, equations, state);
    const std::vector<double> of_loops = state->turns;
    state->turns = of_tree;
    keep_loop_turns(of_loops, state);
    equations->track_turns(state);
    before = *state;
  }
}

}  // namespace codesign
