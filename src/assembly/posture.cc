// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/posture.h"

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "equations/equations.h"

namespace codesign {
namespace {

// Relative; tree coordinates that differ by less belong to one branch.
constexpr double kSameBranch = 1e-6;

}  // namespace

bool is_same_branch(const VectorX<double>& theta, const VectorX<double>& other) {
  return (theta - other).cwiseAbs().maxCoeff() <= kSameBranch * (1.0 + theta.cwiseAbs().maxCoeff());
}

void place(const TreeLoops& loops, const StartDesign& design, const Posture& posture,
           std::vector<LinkMotion<double>>* links, State<double>* state) {
  const CompiledSystem& system = loops.system;
  const Constants<double>& constants = design.equations->constants();
  set_turns(system, loops.tree, posture.theta, state);
  link_motions(system.robot(), loops.tree, design.parameters, posture.theta, posture.rate, links);
  state_coordinates(system, loops.tree, constants, *links, posture.theta, posture.rate, &state->q,
                    &state->v);
  set_signs(system, constants, *links, state);
}

void follow_gears(const TreeLayout& tree, Posture* posture) {
  for (const auto& [motor, joint] : tree.motors) {
    posture->theta[motor] = posture->theta[joint];
    posture->rate[motor] = posture->rate[joint];
  }
}

}  // namespace codesign
