// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/motor_sides.h"

#include <algorithm>

namespace codesign {
namespace {

bool moves_apart(const JointDescription& joint, const MotionStudy& study) {
  if (!joint.has_elastic_gear() || study.rigid_gears || study.postures > 0) return false;
  return !has_given_motion(study, joint.name);
}

JointDescription motor_side(const JointDescription& joint, int link) {
  JointDescription motor;
  motor.name = joint.name + "/motor";
  motor.type = joint.is_turn() ? JointType::kContinuous : JointType::kPrismatic;
  motor.parent = joint.parent;
  motor.child = link;
  motor.origin = joint.origin;
  motor.axis = joint.axis;
  motor.actuator = joint.actuator;
  motor.armature = joint.armature;
  motor.actuator->elastic.reset();
  if (joint.limit) {
    motor.limit.emplace();
    motor.limit->effort = joint.limit->effort;
  }
  motor.is_motor = true;
  motor.where = joint.actuator->where;
  return motor;
}

}  // namespace

RobotDescription without_motor_sides(RobotDescription robot) {
  while (!robot.joints.empty() && robot.joints.back().is_motor) {
    robot.joints.pop_back();
    robot.links.pop_back();
  }
  for (JointDescription& joint : robot.joints) joint.motor = -1;
  return robot;
}

RobotDescription with_motor_sides(RobotDescription robot, const MotionStudy& study) {
  robot = without_motor_sides(std::move(robot));
  const std::size_t joints = robot.joints.size();
  for (std::size_t k = 0; k < joints; ++k) {
    if (!moves_apart(robot.joints[k], study)) continue;
    JointDescription motor = motor_side(robot.joints[k], static_cast<int>(robot.links.size()));
    LinkDescription link;
    link.name = motor.name;
    link.where = motor.where;
    robot.joints[k].motor = static_cast<int>(robot.joints.size());
    robot.joints.push_back(std::move(motor));
    robot.links.push_back(std::move(link));
  }
  return robot;
}

std::string joint_of_motor(const RobotDescription& robot, const std::string& name) {
  for (const JointDescription& joint : robot.joints)
    if (joint.motor >= 0 && robot.joints[to_index(joint.motor)].name == name) return joint.name;
  return name;
}

}  // namespace codesign
