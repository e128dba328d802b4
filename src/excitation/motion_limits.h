// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/effort/driven_system.h"
#include "mechanism_codesign/problem.h"

namespace codesign {

/// A number that must stay between two limits.
struct LimitedSignal {
  enum class Kind { kPosition, kVelocity, kAcceleration, kEffort };
  Kind kind = Kind::kPosition;
  bool is_follower = false;
  Eigen::Index joint = 0;           ///< index among the excited joints, or among the followers
  double lower = 0.0, upper = 0.0;  ///< lower < upper
  std::string name;                 ///< `elbow_joint/velocity`

  double middle() const { return 0.5 * (lower + upper); }
  double half() const { return 0.5 * (upper - lower); }
  /// -1 at the lower limit, 1 at the upper one.
  double relative(double value) const { return (value - middle()) / half(); }
};

/// The excited joints, and the limits of their motion.
struct MotionLimits {
  std::vector<MeasuredJoint> joints, followers;
  Eigen::VectorXd noise;  ///< standard deviations of the efforts of `joints` [N m or N]
  std::vector<LimitedSignal> signals;  ///< limits of `joints`, in their order, then of `followers`

  /// The limit of this kind of an excited joint; null: none.
  const LimitedSignal* find(Eigen::Index joint, LimitedSignal::Kind kind) const;
};

/// The narrower limits of `<limit>` and the study's `excite:`. Followers are the joints of the tree
/// that have a limit and are not excited.
/// @param problem with a block `excite` in its study.
/// @throws InputError for ranges that exclude each other, excited joints without a largest
/// velocity, and limits of joints that move no mass
MotionLimits motion_limits(const Problem& problem);

}  // namespace codesign
