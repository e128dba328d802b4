// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with(const std::string& joint, const std::string& start) {
  return kLeastStudy + "parameters: {a: {initial: 0.5}}\ninitial_state:\n  " + joint + ": " +
         start + "\n";
}

/// The fixture's robot, whose planar joint has the normal z, with one more body on a floating
/// joint.
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

void expect_refused(const std::string& joint, const std::string& start, const std::string& element,
                    const std::string& message) {
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
  const InitialJointState s =
      read("free",
           "{translation: [1, \"${a}\", 3], rotation: [0.1, 0.2, \"${2*a}\"], linear_velocity: [4, "
           "5, 6], angular_velocity: [7, 8, 9]}");
  EXPECT_EQ((*s.translation)[1].nominal(), 0.5);
  EXPECT_EQ((*s.rotation)[2].nominal(), 1.0);
  EXPECT_EQ((*s.linear_velocity)[2].nominal(), 6.0);
  EXPECT_EQ((*s.angular_velocity)[0].nominal(), 7.0);
  EXPECT_FALSE(s.position || s.velocity || s.guess);
}

TEST(StudyInitialState, OfAPlanarJoint) {
  const InitialJointState s = read("ball_joint",
                                   "{translation: [1, 2, 0], rotation: \"${a}\", linear_velocity: "
                                   "[4, 5, 0], angular_velocity: 6}");
  EXPECT_EQ((*s.translation)[1].nominal(), 2.0);
  EXPECT_EQ((*s.rotation)[2].nominal(), 0.5);
  EXPECT_EQ((*s.angular_velocity)[2].nominal(), 6.0);
}

TEST(StudyInitialState, AnAngularVelocityNeedsARotation) {
  EXPECT_TRUE(read("free", "{angular_velocity: [0, 0, 1]}").rotation.has_value());
  EXPECT_FALSE(read("free", "{linear_velocity: [0, 0, 1]}").rotation.has_value());
}

/// The robot whose crank, ball joint and loop rub under a law with states.
RobotDescription rubbing_robot() {
  RobotDescription robot = flying_robot();
  for (JointDescription& joint : robot.joints)
    if (joint.name != "free") joint.friction.emplace().model = FrictionModel::kLuGre;
  robot.joints.back().friction.emplace();
  return robot;
}

TEST(StudyInitialState, AStuckJointIsAtRest) {
  const auto start = [](const std::string& joint, const std::string& text) {
    return read_study({"study.yaml", with(joint, text)}, rubbing_robot()).initial_state.at(0);
  };
  const InitialJointState crank = start("crank_joint", "{position: 0.3, stuck: true}");
  EXPECT_TRUE(crank.stuck);
  EXPECT_EQ(crank.velocity->nominal(), 0.0);
  const InitialJointState ball = start("ball_joint", "{stuck: true}");
  EXPECT_TRUE(ball.stuck && ball.linear_velocity && ball.angular_velocity);
  EXPECT_FALSE(ball.rotation || ball.translation) << "found by the assembly";
  const InitialJointState moves = start("crank_joint", "{velocity: 2, stuck: false}");
  EXPECT_FALSE(moves.stuck);
  EXPECT_EQ(moves.velocity->nominal(), 2.0);
}

TEST(StudyInitialState, RefusesAStuckJointThatNothingHolds) {
  const std::string kMotion = "motion: {crank_joint: {position: 0.1}}\n";
  RobotDescription robot = rubbing_robot();
  const auto refused = [&](const std::string& joint, const std::string& start,
                           const std::string& message, const std::string& more = "") {
    try {
      read_study({"study.yaml", with(joint, start) + more}, robot);
      ADD_FAILURE() << joint << " " << start;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      EXPECT_EQ(error.fault().where.line, more == kMotion ? 6 : 5) << error.what();
    }
  };
  refused("free", "{stuck: true}", "no friction with states");
  refused("crank_joint", "{velocity: 0, stuck: true}", "either stuck or a velocity");
  refused("crank_joint", "{stuck: 1}", "true or false");
  refused("crank_joint", "{stuk: true}", "did you mean \"stuck\"");
  refused("crank_joint", "{stuck: true}", "the motion of the joint is given", kMotion);
  refused("crank_joint", "{stuck: true}", "either stuck or identify", "identify: {}\n");
  try {
    read_study({"study.yaml",
                "positions: {slider_joint: [0.1, 0.2]}\ninitial_state: {crank_joint: {stuck: "
                "true}}\nobjective: {sum: [{signal: crank_joint/position}]}\n"},
               robot);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().allowed, "either stuck or positions") << error.what();
  }
  for (JointDescription& joint : robot.joints) joint.friction.reset();
  ActuatorDescription& actuator = robot.joints[0].actuator.emplace();
  actuator.gear.emplace().slip.model = FrictionModel::kLuGre;
  const std::string crank = robot.joints[0].name;
  EXPECT_TRUE(
      read_study({"study.yaml", with(crank, "{stuck: true}")}, robot).initial_state.at(0).stuck);
  actuator.elastic.emplace();
  refused(crank, "{stuck: true}", "the gear of the joint is elastic");
}

TEST(StudyInitialState, RefusesWhatTheJointHasNot) {
  expect_refused("free", "{position: 1}", ".position", "no position");
  expect_refused("crank_joint", "{translation: [0, 0, 0]}", ".translation", "no translation");
  expect_refused("free", "{}", "", "no initial state is given");
  expect_refused("free", "{rotation: 0.3}", ".rotation", "three components");
  expect_refused("ball_joint", "{rotation: [0, 0, 0.3]}", ".rotation", "only about its normal");
  expect_refused("ball_joint", "{translation: [0, 0, 0.3]}", ".translation",
                 "does not lie in the plane");
  expect_refused("ball_joint", "{linear_velocity: [0, 0, 0.3]}", ".linear_velocity",
                 "does not lie in the plane");
  expect_refused("free", "{translatoin: [0, 0, 0]}", ".translatoin",
                 "did you mean \"translation\"");
}

TEST(StudyInitialState, OfAScalarJoint) {
  const InitialJointState s = read("crank_joint", "{position: \"${a}\", velocity: 2}");
  EXPECT_EQ(s.position->nominal(), 0.5);
  EXPECT_EQ(s.velocity->nominal(), 2.0);
  expect_refused("crank_joint", "{position: 1, guess: 2}", ".guess", "either");
  expect_refused("crank_jont", "{position: 1}", "", "did you mean \"crank_joint\"");
}

std::string with(const std::string& loads) {
  return kLeastStudy + "parameters: {push: {initial: 2}}\nloads:\n  - " + loads + "\n";
}

TEST(StudyLoads, ReadsAnEffort) {
  const LoadDescription load =
      read_text(with("{joint: slider_joint, effort: \"${3*push}\"}")).loads.at(0);
  EXPECT_EQ(load.joint, "slider_joint");
  EXPECT_TRUE(load.link.empty());
  EXPECT_EQ(load.effort.of_time.constant.nominal(), 6.0);
  EXPECT_EQ(load.effort.of_time.constant.at(std::vector<double>{0.08, 0.3, 4.0}), 12.0);
  EXPECT_EQ(load.where.line, 5);
}

TEST(StudyLoads, ReadsAWrench) {
  const Study study =
      read_text(with("{link: ball, force: [1, \"${push}\", 0], torque: [0, 0, 0.5], point: [0, "
                     "0.1, 0], frame: link}\n  - {link: "
                     "crank, torque: [1, 0, 0]}"));
  const LoadDescription& first = study.loads.at(0);
  EXPECT_EQ(first.link, "ball");
  EXPECT_EQ(first.force[1].of_time.constant.nominal(), 2.0);
  EXPECT_EQ(first.torque[2].of_time.constant.nominal(), 0.5);
  EXPECT_EQ(first.point[1].nominal(), 0.1);
  EXPECT_TRUE(first.in_link_frame);
  EXPECT_FALSE(study.loads.at(1).in_link_frame);
  EXPECT_EQ(study.loads.at(1).force[0].of_time.constant.nominal(), 0.0);
}

TEST(StudyLoads, ReadsFunctionsOfTimeAndExpressionsOfSignals) {
  const Study study =
      read_text(with("{link: ball, force: [{type: sine, amplitude: 1, period: 2}, \"${push*t}\", "
                     "\"${-push*ball/velocity/x}\"]}\n  - {joint: slider_joint, effort: "
                     "\"${slider_joint/position^2}\"}"));
  const LoadDescription& wrench = study.loads.at(0);
  EXPECT_EQ(wrench.force[0].of_time.kind, ReferenceDescription::Kind::kSine);
  EXPECT_EQ(wrench.force[1].of_time.kind, ReferenceDescription::Kind::kExpression);
  EXPECT_FALSE(wrench.force[1].of_signals);
  ASSERT_TRUE(wrench.force[2].of_signals);
  EXPECT_EQ(wrench.force[2].of_signals->terms.at(0).object, "ball");
  EXPECT_TRUE(study.loads.at(1).effort.of_signals);
  EXPECT_EQ(study.used_parameters.count(2), 1U);
  expect_fault(with("{joint: slider_joint, effort: \"${slider_jont/position}\"}"),
               "loads[0].effort", "did you mean \"slider_joint\"", 5);
  expect_fault(with("{joint: slider_joint, effort: \"${slider_joint/positon}\"}"),
               "loads[0].effort", "did you mean \"position\"", 5);
}

}  // namespace
}  // namespace codesign
