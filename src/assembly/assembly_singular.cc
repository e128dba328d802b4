// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that start at a singular position.
#include "assembly/assembly.h"
#include "math/arrays.h"

namespace codesign {

// At a singular position where several motions meet, rates can satisfy the loops to first order
// without belonging to any motion.
Status Assembly::choose_branch(const std::vector<double>& parameters,
                               Equations<double>* equations) {
  singular_start_.load(parameters, theta_, equations);
  if (singular_start_.is_motion(theta_rate_)) return {};
  const std::string joints = singular_start_.joints();
  const std::string where =
      "the start is a singular position, where several motions of " + joints + " meet";
  std::vector<bool> held = velocity_given_;
  for (std::size_t k = 0; k < followers_.size(); ++k)
    if (system_.topology().couplings[k].motion >= 0 && followers_[k] >= 0)
      held[to_index(followers_[k])] = true;
  if (!singular_start_.choose_motion(held, &theta_rate_))
    return {StatusCode::kSingularConfiguration, 0.0,
            where + ", and the given velocities belong to none of them"};
  warnings_.push_back({"singular_start",
                       where + ", and the given velocities do not determine which one begins: one "
                               "was chosen, and gradients do not include "
                               "this choice. Give the initial velocity of one more of these "
                               "joints, or start from another position",
                       {}});
  return {};
}

// From rest, the accelerations take the place of the velocities in the check for a possible motion,
// doc/theory.md (19a).
Status Assembly::check_rest(const State<double>& state) {
  if (!theta_rate_.isZero(0.0) || !singular_start_.is_singular()) return {};
  const VectorX<double>& accelerations =
      singular_start_.tree_accelerations(In<double>(state.z).first(system_.layout().n));
  if (accelerations.size() == 0 || accelerations.cwiseAbs().maxCoeff() < 1e-9 ||
      singular_start_.is_motion(accelerations))
    return {};
  return {StatusCode::kSingularConfiguration, 0.0,
          "the start is at rest in a singular position, where several motions of " +
              singular_start_.joints() +
              " meet, and the forces do not determine which one begins: give initial velocities, "
              "or start from another position"};
}

}  // namespace codesign
