// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_turns.h"

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kPartOfTurn = 3.0;  // [rad or m] of all coordinates together

/// Of a free body, p and -p are the same position; the way between both states has to be short.
void take_near_sides(const System& system, const State<double>& before, State<double>* state) {
  for (int b = 0; b < system.layout().bodies; ++b) {
    if (!system.layout().is_free(b)) continue;
    auto p = state->q.segment<4>(system.layout().column(b) + 3);
    if (p.dot(before.q.segment<4>(system.layout().column(b) + 3)) < 0.0) p *= -1.0;
  }
}

}  // namespace

void keep_loop_turns(const System& system, const std::vector<double>& turns, State<double>* state) {
  const std::vector<Pair>& pairs = system.topology().pairs;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!pairs[p].is_loop) continue;
    for (std::size_t e = 0; e < pairs[p].chain.size(); ++e) {
      const auto slot = to_index(system.layout().turn(static_cast<int>(p), static_cast<int>(e)));
      state->turns[slot] = turns[slot];
    }
  }
}

void count_turns(const TreeLoops& loops, const StartDesign& design, const VectorX<double>& from,
                 const Posture& to, TurnFollower<double>* follower, State<double>* state) {
  const int parts = 1 + static_cast<int>((to.theta - from).cwiseAbs().sum() / kPartOfTurn);
  Posture posture = to;
  std::vector<LinkMotion<double>> links;
  State<double> before = *state;
  for (int part = 1; part <= parts; ++part) {
    posture.theta =
        part == parts ? to.theta : VectorX<double>(from + (to.theta - from) * part / parts);
    place(loops, design, posture, &links, state);
    take_near_sides(loops.system, before, state);
    const std::vector<double> of_tree = state->turns;
    follower->follow(before, design.equations, state);
    const std::vector<double> of_loops = state->turns;
    state->turns = of_tree;
    keep_loop_turns(loops.system, of_loops, state);
    design.equations->track_turns(state);
    before = *state;
  }
}

}  // namespace codesign
