// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/friction_geometry.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// The error that the check throws; empty if it passes.
std::string complaint(const FrictionDescription& friction, JointType type) {
  JointDescription joint;
  joint.type = type;
  try {
    check_friction_geometry(friction, kind_of(joint), "<joint>");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FrictionGeometry, EachJointTypeNeedsItsDimensions) {
  FrictionDescription friction;
  friction.where = {"a.urdf", 3};
  EXPECT_EQ(complaint(friction, JointType::kPlanar), "");
  EXPECT_EQ(complaint(friction, JointType::kPrismatic),
            "a.urdf:3: <joint>: the friction of this joint type needs the attribute joint_length (allowed: > 0)");
  friction.joint_length = 0.1;
  EXPECT_NE(complaint(friction, JointType::kPrismatic).find("joint_width"), std::string::npos);
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kCylindrical, JointType::kSpherical})
    EXPECT_NE(complaint(friction, type).find("pin_radius"), std::string::npos);
  friction.joint_width = 0.1;
  EXPECT_EQ(complaint(friction, JointType::kPrismatic), "");
  friction.pin_radius = 0.1;
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kCylindrical, JointType::kSpherical})
    EXPECT_EQ(complaint(friction, type), "");
}

TEST(FrictionGeometry, WhatSlipsInSeveralDirectionsHasNoBackward) {
  FrictionDescription friction;
  friction.joint_length = friction.joint_width = friction.pin_radius = 0.1;
  friction.is_directional = true;
  for (JointType type : {JointType::kPrismatic, JointType::kRevolute, JointType::kContinuous, JointType::kCylindrical})
    EXPECT_EQ(complaint(friction, type), "");
  for (JointType type : {JointType::kSpherical, JointType::kPlanar})
    EXPECT_NE(complaint(friction, type).find("slips in several directions"), std::string::npos);
}

TEST(FrictionGeometry, SomeJointsHaveNoFrictionLaw) {
  FrictionDescription friction;
  friction.joint_length = friction.joint_width = friction.pin_radius = 0.1;
  for (JointType type : {JointType::kFixed, JointType::kFloating, JointType::kUniversal, JointType::kDistance})
    EXPECT_NE(complaint(friction, type).find("no friction law"), std::string::npos);
}

}  // namespace
}  // namespace codesign
