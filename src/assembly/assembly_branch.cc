// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The checks of Assembly on the velocities, and from rest the accelerations, of the start.
#include <cmath>

#include "assembly/assembly.h"
#include "assembly/given_start.h"

namespace codesign {
namespace {

constexpr double kTakesPart = 1e-9;  // smaller entries of the loops' Jacobian count as zero

}  // namespace

// The message names the joints with a given velocity that appear in a violated row.
Status Assembly::contradiction() {
  const VectorX<double>& left = work_.left;
  const double most = left.cwiseAbs().maxCoeff();
  std::string joints, loop;
  const std::vector<InitialJointState>& given = system_.study().initial_state;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const int joint = tree_joint(system_.robot(), given[k]);
    if (joint < 0 || !given[k].velocity) continue;
    for (Eigen::Index row = 0; row < left.size(); ++row) {
      if (std::abs(left[row]) < 1e-3 * most) continue;
      loop = loops_.owner(static_cast<int>(row));
      if (std::abs(work_.enforced.coeff(row, tree_.offset[static_cast<std::size_t>(joint)])) < kTakesPart) continue;
      joints += (joints.empty() ? "'" : ", '") + given[k].joint + "'";
      contradicting_.push_back(k);
      break;
    }
  }
  return {StatusCode::kInitialVelocityFailed, 0.0,
          "the given initial velocities of " + joints + " contradict each other: loop or coupling '" + loop + "' cannot follow them"};
}

// At a singular position where several motions meet, rates can satisfy the loops to first order without belonging to any motion.
Status Assembly::choose_branch(const std::vector<double>& parameters, Equations<double>* equations) {
  singular_start_.load(parameters, theta_, equations);
  if (singular_start_.is_motion(theta_rate_)) return {};
  const std::string joints = singular_start_.joints();
  const std::string where = "the start is a singular position, where several motions of " + joints + " meet";
  if (!singular_start_.choose_motion(velocity_given_, &theta_rate_))
    return {StatusCode::kSingularConfiguration, 0.0, where + ", and the given velocities belong to none of them"};
  warnings_.push_back({"singular_start",
                       where + ", and the given velocities do not determine which one begins: one was chosen, and gradients do not include "
                               "this choice. Give the initial velocity of one more of these joints, or start from another position",
                       {}});
  return {};
}

// From rest, the accelerations take the place of the velocities in the check for a possible motion, doc/theory.md (19a).
Status Assembly::check_rest(const State<double>& state) {
  if (!theta_rate_.isZero(0.0) || !singular_start_.is_singular()) return {};
  const VectorX<double>& accelerations = singular_start_.tree_accelerations(In<double>(state.z).first(system_.layout().n));
  if (accelerations.size() == 0 || accelerations.cwiseAbs().maxCoeff() < 1e-9 || singular_start_.is_motion(accelerations)) return {};
  return {StatusCode::kSingularConfiguration, 0.0,
          "the start is at rest in a singular position, where several motions of " + singular_start_.joints() +
              " meet, and the forces do not determine which one begins: give initial velocities, or start from another position"};
}

}  // namespace codesign
