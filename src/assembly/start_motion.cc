// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_motion.h"

#include "assembly/tree_loops.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"

namespace codesign {

Status choose_motion(const TreeLoops& loops, const StartDesign& design, Posture* posture,
                     SingularStart* singular, Warnings* warnings) {
  singular->load(design.parameters, posture->theta, design.equations);
  if (singular->is_motion(posture->rate)) return {};
  const std::string joints = singular->joints();
  const std::string where =
      "the start is a singular position, where several motions of " + joints + " meet";
  std::vector<bool> held = posture->given.velocity;
  loops.followers.mark_driven(&held);
  if (!singular->choose_motion(held, &posture->rate))
    return {StatusCode::kSingularConfiguration, 0.0,
            where + ", and the given velocities belong to none of them"};
  warnings->push_back({"singular_start",
                       where + ", and the given velocities do not determine which one begins: one "
                               "was chosen, and gradients do not include "
                               "this choice. Give the initial velocity of one more of these "
                               "joints, or start from another position",
                       {}});
  return {};
}

Status require_motion(const TreeLoops& loops, const Posture& posture, const State<double>& state,
                      SingularStart* singular) {
  if (!posture.rate.isZero(0.0) || !singular->is_singular()) return {};
  const VectorX<double>& accelerations =
      singular->tree_accelerations(In<double>(state.z).first(loops.system.layout().n));
  if (accelerations.size() == 0 || accelerations.cwiseAbs().maxCoeff() < 1e-9 ||
      singular->is_motion(accelerations))
    return {};
  return {StatusCode::kSingularConfiguration, 0.0,
          "the start is at rest in a singular position, where several motions of " +
              singular->joints() +
              " meet, and the forces do not determine which one begins: give initial velocities, "
              "or start from another position"};
}

}  // namespace codesign
