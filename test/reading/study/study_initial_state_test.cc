// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_initial_state.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with(const std::string& joint, const std::string& start) {
  return kLeastStudy + "parameters: {a: {initial: 0.5}}\ninitial_state:\n  " + joint + ": " + start + "\n";
}

/// The fixture's robot, whose planar joint has the normal z, with one more body on a floating joint.
RobotDescription flying_robot() {
  RobotDescription robot = study_robot();
  robot.joints[2].axis = {0.0, 0.0, 1.0};
  JointDescription joint;
  joint.name = "free";
  joint.type = JointType::kFloating;
  robot.joints.push_back(joint);
  return robot;
}

InitialJointState read(const std::string& joint, const std::string& start) {
  return read_study({"study.yaml", with(joint, start)}, flying_robot()).initial_state.at(0);
}

void expect_refused(const std::string& joint, const std::string& start, const std::string& element, const std::string& message) {
  try {
    read(joint, start);
    ADD_FAILURE() << joint << " " << start;
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "initial_state." + joint + element) << error.what();
    EXPECT_NE(error.fault().message.find(message), std::string::npos) << error.what();
    EXPECT_EQ(error.fault().where.line, 5);
  }
}

TEST(StudyInitialState, OfAFloatingJoint) {
  const InitialJointState s = read(
      "free", "{translation: [1, \"${a}\", 3], rotation: [0.1, 0.2, \"${2*a}\"], linear_velocity: [4, 5, 6], angular_velocity: [7, 8, 9]}");
  EXPECT_EQ((*s.translation)[1].nominal(), 0.5);
  EXPECT_EQ((*s.rotation)[2].nominal(), 1.0);
  EXPECT_EQ((*s.linear_velocity)[2].nominal(), 6.0);
  EXPECT_EQ((*s.angular_velocity)[0].nominal(), 7.0);
  EXPECT_FALSE(s.position || s.velocity || s.guess);
}

TEST(StudyInitialState, OfAPlanarJoint) {
  const InitialJointState s =
      read("ball_joint", "{translation: [1, 2, 0], rotation: \"${a}\", linear_velocity: [4, 5, 0], angular_velocity: 6}");
  EXPECT_EQ((*s.translation)[1].nominal(), 2.0);
  EXPECT_EQ((*s.rotation)[2].nominal(), 0.5);
  EXPECT_EQ((*s.angular_velocity)[2].nominal(), 6.0);
}

TEST(StudyInitialState, AnAngularVelocityNeedsARotation) {
  EXPECT_TRUE(read("free", "{angular_velocity: [0, 0, 1]}").rotation.has_value());
  EXPECT_FALSE(read("free", "{linear_velocity: [0, 0, 1]}").rotation.has_value());
}

TEST(StudyInitialState, RefusesWhatTheJointHasNot) {
  expect_refused("free", "{position: 1}", ".position", "no position");
  expect_refused("crank_joint", "{translation: [0, 0, 0]}", ".translation", "no translation");
  expect_refused("free", "{}", "", "no initial state is given");
  expect_refused("free", "{rotation: 0.3}", ".rotation", "three components");
  expect_refused("ball_joint", "{rotation: [0, 0, 0.3]}", ".rotation", "only about its normal");
  expect_refused("ball_joint", "{translation: [0, 0, 0.3]}", ".translation", "does not lie in the plane");
  expect_refused("ball_joint", "{linear_velocity: [0, 0, 0.3]}", ".linear_velocity", "does not lie in the plane");
  expect_refused("free", "{translatoin: [0, 0, 0]}", ".translatoin", "did you mean \"translation\"");
}

TEST(StudyInitialState, OfAScalarJoint) {
  const InitialJointState s = read("crank_joint", "{position: \"${a}\", velocity: 2}");
  EXPECT_EQ(s.position->nominal(), 0.5);
  EXPECT_EQ(s.velocity->nominal(), 2.0);
  expect_refused("crank_joint", "{position: 1, guess: 2}", ".guess", "either");
  expect_refused("crank_jont", "{position: 1}", "", "did you mean \"crank_joint\"");
}

}  // namespace
}  // namespace codesign
