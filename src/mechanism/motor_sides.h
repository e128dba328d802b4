// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/motion_study.h"
#include "description/robot.h"

namespace codesign {

/// The model in which the motors behind elastic gears move by themselves, theory (9c): after the
/// joints of the files each of them has a joint of its own, NAME/motor with JointDescription::
/// is_motor, beside its joint NAME, whose JointDescription::motor it is. It has the same parent,
/// origin and axis, turns a link without mass, and holds rotor, losses and effort limit of the
/// actuator. Its coordinate is the motor's position over the gear ratio.
///
/// A gear is rigid, and adds no joint, where the study gives the motion: of its joint
/// (MotionStudy::motion), of a list of postures, or MotionStudy::rigid_gears.
/// @param robot as the files describe it, or a result of this function.
RobotDescription with_motor_sides(RobotDescription robot, const MotionStudy& study);

/// The model as the files describe it, without the joints that with_motor_sides() adds.
RobotDescription without_motor_sides(RobotDescription robot);

/// The joint beside which a motor stands; of another joint its own name. @param robot with motors
std::string joint_of_motor(const RobotDescription& robot, const std::string& name);

}  // namespace codesign
