// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/setpoint_motion.h"

#include <algorithm>

#include "description/motion_study.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// The joint whose position a controller controls; empty if it controls something else.
std::string controlled_joint(const ControllerDescription& controller) {
  if (!controller.kind->has_error()) return "";
  const SignalTerm* input = controller.input.only_term();
  return input && input->quantity == "position" && input->component.empty() ? input->object : "";
}

}  // namespace

SetpointMotion::SetpointMotion(const MotionStudy& study, const std::vector<double>& parameters) {
  for (const GivenMotion& motion : study.motion) {
    joints_.push_back({motion.joint, true, 1.0, motion.where});
    motions_.emplace_back(motion.position, parameters);
  }
  for (const ControllerDescription& controller : study.controllers) {
    const std::string joint = controlled_joint(controller);
    if (joint.empty()) continue;
    if (std::any_of(joints_.begin(), joints_.end(),
                    [&](const MeasuredJoint& other) { return other.name == joint; }))
      throw InputError({controller.where, "controllers." + controller.name,
                        "two controllers, or a motion and a controller, give the position of one "
                        "joint",
                        joint, "one controller with " + joint + "/position as its input"});
    joints_.push_back({joint, true, 1.0, controller.where});
    motions_.emplace_back(controller.setpoint, parameters);
  }
  if (joints_.empty())
    throw InputError(
        {{study.file, 1},
         "controllers",
         "the study gives no motion: it has no `motion`, and no controller controls the "
         "position of a joint",
         "",
         "motion: {JOINT: {position: FUNCTION}}, or a controller with the input "
         "JOINT/position, or of the type computed_torque or pd_gravity; or postures in "
         "efforts.grid"});
}

void SetpointMotion::at(double time, Eigen::VectorXd (*given)[3]) const {
  for (Eigen::VectorXd& order : *given) order.resize(to_signed(joints_.size()));
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const ReferenceMotion<double> motion = motions_[k].at(time);
    const auto row = to_signed(k);
    (*given)[0][row] = motion.value;
    (*given)[1][row] = motion.rate;
    (*given)[2][row] = motion.acceleration;
  }
}

Eigen::MatrixXd SetpointMotion::some_positions(double duration) const {
  constexpr int kInstants = 4;
  Eigen::MatrixXd some(to_signed(joints_.size()), kInstants);
  Eigen::VectorXd given[3];
  for (int k = 0; k < kInstants; ++k) {
    at(duration * k / kInstants, &given);
    some.col(k) = given[0];
  }
  return some;
}

}  // namespace codesign
