// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/first_posture.h"

#include "assembly/tree_coordinates.h"
#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

FirstPosture::FirstPosture(const TreeLoops& loops)
    : loops_(loops), own_design_(loops.system.parameters()) {}

void FirstPosture::begin_at(double time, const VectorX<double>& theta) {
  time_ = time;
  guess_ = theta;
}

void FirstPosture::set(const std::vector<double>& parameters, Posture* posture) const {
  const CompiledSystem& system = loops_.system;
  VectorX<double>& theta = posture->theta;
  theta.setZero(loops_.tree.size);
  posture->rate.setZero(loops_.tree.size);
  for (const InitialJointState& initial : system.study().initial_state) {
    const int joint = tree_joint(system.robot(), initial);
    if (joint >= 0 && initial.guess) theta[loops_.tree.offset[to_index(joint)]] = *initial.guess;
  }
  if (has_guess()) theta = guess_;
  if (!has_guess() && nudge_.size() > 0) theta += nudge_;
  set_given_start(system, loops_.tree, parameters, posture->number, &theta, &posture->rate);
}

}  // namespace codesign
