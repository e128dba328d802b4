// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/posture_efforts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arrays.h"

namespace codesign {
namespace {

// [rad/s or m/s] speed of a drive that begins to move: of no account but by its sign, since
// inertia and damping at this speed are far below rounding.
constexpr double kSlip = 1e-9;
// [m/s or rad/s] a joint a millionth as fast as the drive slips wholly; rounding, 1e-16 of the
// drive's speed, does not.
constexpr double kTransition = 1e-6 * kSlip;

/// The mechanism whose friction has its static coefficient at any speed above kTransition. A law
/// with states holds up to the same coefficient.
RobotDescription with_static_friction(RobotDescription robot) {
  const auto set = [](FrictionDescription* friction) {
    if (friction->model->bristle) friction->model = FrictionModel::kBrownMcPhee;
    friction->mu_dynamic = friction->mu_static;
    friction->mu_dynamic_backward = friction->mu_static_backward;
    friction->transition_velocity = Quantity(kTransition);
    friction->transition_follows = false;
    // A power of the speed below one is of account even at kSlip.
    friction->viscous = friction->viscous_backward = Quantity(0.0);
  };
  for (JointDescription& joint : robot.joints) {
    joint.dry_transition_velocity = kTransition;
    if (joint.friction) set(&*joint.friction);
    if (joint.actuator && joint.actuator->gear) set(&joint.actuator->gear->slip);
  }
  return robot;
}

Eigen::MatrixXd some_postures(const PostureGrid& grid) {
  constexpr std::size_t kSome = 4;
  const std::size_t count = count_postures(grid);
  Eigen::MatrixXd some(to_signed(grid.size()), to_signed(kSome));
  for (std::size_t k = 0; k < kSome; ++k)
    some.col(to_signed(k)) = posture(grid, k * (count - 1) / kSome);
  return some;
}

DrivenReplay held(const CompiledSystem& system, const PostureGrid& grid,
                  const std::vector<double>& parameters,
                  const std::vector<SignalDescription>& signals) {
  refuse_loads_of_time(system, "postures at rest have no time");
  try {
    return DrivenReplay(system, driven_joints(grid), some_postures(grid), parameters, signals);
  } catch (const InputError& error) {
    throw InputError(in_words_of_study(
        error.fault(), "efforts.grid",
        "its position is not determined: it is not in efforts.grid, and does not follow from the "
        "joints there",
        "as many independent joints in efforts.grid as there are degrees of freedom"));
  }
}

}  // namespace

std::vector<MeasuredJoint> driven_joints(const PostureGrid& grid) {
  std::vector<MeasuredJoint> joints;
  for (const GridJoint& joint : grid) joints.push_back({joint.joint, true, 1.0, joint.where});
  return joints;
}

Eigen::VectorXd posture(const PostureGrid& grid, std::size_t index) {
  Eigen::VectorXd positions(to_signed(grid.size()));
  for (std::size_t k = grid.size(); k-- > 0;) {
    const std::vector<double>& of = grid[k].positions;
    positions[to_signed(k)] = of[index % of.size()];
    index /= of.size();
  }
  return positions;
}

PostureStatics::PostureStatics(const CompiledSystem& system, const PostureGrid& grid,
                               const std::vector<double>& parameters,
                               const std::vector<SignalDescription>& signals)
    : sliding_(with_static_friction(system.robot()), system.whole_study(), system.sharing()),
      replay_(held(sliding_, grid, parameters, signals)) {}

double PostureStatics::slipping(const Eigen::VectorXd& positions, std::size_t drive,
                                double direction) {
  Eigen::VectorXd given[] = {positions, Eigen::VectorXd::Zero(positions.size()),
                             Eigen::VectorXd::Zero(positions.size())};
  given[1][to_signed(drive)] = direction * kSlip;
  if (!replay_.show(0.0, given, &frame_).ok())
    return direction * std::numeric_limits<double>::infinity();
  return frame_.joints[drives()[drive]].effort;
}

Status PostureStatics::show(const Eigen::VectorXd& positions, Frame* frame,
                            std::vector<PostureEffort>* efforts) {
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(positions.size());
  const Eigen::VectorXd given[] = {positions, still, still};
  is_singular_ = false;
  if (Status status = replay_.show(0.0, given, frame); !status.ok()) {
    is_singular_ = status.code == StatusCode::kSingularMatrix;
    return status;
  }
  is_singular_ = replay_.is_singular();
  efforts->assign(drives().size(), {});
  for (std::size_t k = 0; k < efforts->size(); ++k) {
    PostureEffort& effort = (*efforts)[k];
    effort.rest = frame->joints[drives()[k]].effort;
    const double rounding = 1e-9 * (1.0 + std::abs(effort.rest));
    // A solution in which friction would drive the motion belongs to no effort: where friction
    // grows faster than the effort that overcomes it, the mechanism locks.
    const auto end = [&](double direction) {
      if (is_singular_) return direction * std::numeric_limits<double>::infinity();
      const double slip = slipping(positions, k, direction);
      const bool opposes = direction * (slip - effort.rest) >= -rounding;
      return opposes ? slip : direction * std::numeric_limits<double>::infinity();
    };
    effort.lower = end(-1.0);
    effort.upper = end(1.0);
  }
  return {};
}

}  // namespace codesign
