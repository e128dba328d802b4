// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string text_of(const std::string& type, const std::string& input, const std::string& setpoint,
                    const std::string& output, const std::string& gains) {
  return kLeastStudy + "parameters: {Kp: {initial: 2}}\ncontrollers:\n  speed: {type: " + type +
         ", input: " + input + ", setpoint: " + setpoint + ", output: " + output +
         ", gains: " + gains + "}\n";
}

TEST(StudyControllers, ReadsEveryField) {
  const Study study = read_text(
      text_of("pid", "crank_joint/velocity", "-10.0", "crank_joint", "{p: \"${Kp}\", d: 0.5}"));
  const ControllerDescription& controller = study.controllers.at(0);
  EXPECT_EQ(controller.name, "speed");
  EXPECT_EQ(controller.kind, ControllerKind::kPid);
  EXPECT_EQ(controller.input.terms.at(0).object, "crank_joint");
  EXPECT_EQ(controller.setpoint.constant.nominal(), -10.0);
  EXPECT_EQ(controller.output, "crank_joint");
  EXPECT_EQ(controller.p.nominal(), 2.0);
  EXPECT_EQ(controller.p.at(std::vector<double>{0.08, 0.3, 4.0}), 4.0);
  EXPECT_EQ(controller.i.nominal(), 0.0);
  EXPECT_EQ(controller.d.nominal(), 0.5);
  EXPECT_EQ(controller.where.line, 5);
}

TEST(StudyControllers, AnInputMayReadEarlierControllersOnly) {
  const std::string outer =
      "  outer: {type: pid, input: slider_joint/position, setpoint: 0, output: slider_joint, "
      "gains: {p: 1}}\n";
  const std::string inner =
      "  inner: {type: pid, input: crank_joint/velocity - outer/output, setpoint: 0, output: "
      "crank_joint, gains: {p: 1}}\n";
  EXPECT_EQ(read_text(kLeastStudy + "controllers:\n" + outer + inner)
                .controllers.at(1)
                .input.terms.at(1)
                .object,
            "outer");
  expect_fault(kLeastStudy + "controllers:\n" + inner + outer, "controllers.inner.input",
               "unknown joint, link, spring, contact or controller", 4);
}

TEST(StudyControllers, LawsThatKnowTheModelReadTheJointTheyDrive) {
  const std::string tail =
      ": {output: crank_joint, setpoint: {type: sine, amplitude: 1.0, period: 2.0}, gains: {p: "
      "3.0, d: 0.5}, type: ";
  const Study study = read_text(kLeastStudy + "controllers:\n  a" + tail + "pd_gravity}\n  b" +
                                tail + "computed_torque}\n");
  EXPECT_EQ(study.controllers.at(0).kind, ControllerKind::kPdGravity);
  EXPECT_EQ(study.controllers.at(1).kind, ControllerKind::kComputedTorque);
  for (const ControllerDescription& controller : study.controllers) {
    EXPECT_EQ(controller.input.text, "crank_joint/position");
    EXPECT_EQ(controller.setpoint.kind, ReferenceDescription::Kind::kSine);
    EXPECT_EQ(controller.p.nominal(), 3.0);
    EXPECT_EQ(controller.d.nominal(), 0.5);
  }
  const std::string start =
      kLeastStudy + "controllers: {a: {type: pd_gravity, output: crank_joint, setpoint: 0.0, ";
  expect_fault(start + "gains: {p: 1, i: 2}}}\n", "controllers.a.gains.i", "unknown key", 3);
  expect_fault(start + "gains: {p: 1}, input: crank_joint/position}}\n", "controllers.a.input",
               "unknown key", 3);
}

TEST(StudyControllers, StateFeedbackIsAListOfSignalsWithGains) {
  const std::string start =
      kLeastStudy + "controllers: {a: {type: state_feedback, output: slider_joint, ";
  const Study study = read_text(start +
                                "feedforward: 2.0, feedback: [{signal: slider_joint/position, "
                                "gain: 3.0, reference: {type: waypoints, times: [0, 1], "
                                "positions: [0, 1]}}, {signal: slider_joint/velocity - "
                                "crank_joint/velocity, gain: \"${rod_length}\"}]}}\n");
  const ControllerDescription& a = study.controllers.at(0);
  EXPECT_EQ(a.kind, ControllerKind::kStateFeedback);
  EXPECT_EQ(a.feedforward.constant.nominal(), 2.0);
  ASSERT_EQ(a.feedback.size(), 2U);
  EXPECT_EQ(a.feedback[0].reference.kind, ReferenceDescription::Kind::kWaypoints);
  EXPECT_EQ(a.feedback[1].signal.terms.size(), 2U);
  EXPECT_EQ(a.feedback[1].gain.nominal(), 0.3);
  expect_fault(start + "feedback: []}}\n", "controllers.a", "does nothing", 3);
  expect_fault(kLeastStudy + "controllers: {a: {type: state_feedback, output: slider_joint}}\n",
               "controllers.a", "does nothing", 3);
  EXPECT_TRUE(
      read_text(start + "feedforward: \"${rod_length}\"}}\n").controllers.at(0).feedback.empty());
  expect_fault(start + "feedback: [{signal: slider_joint/position}]}}\n",
               "controllers.a.feedback[0].gain", "required key is missing", 3);
  expect_fault(start + "feedback: [{signal: slider_joint/position, gian: 1, gain: 1}]}}\n",
               "controllers.a.feedback[0].gian", "did you mean \"gain\"", 3);
  expect_fault(start + "feedback: [{signal: slider_joint/pos, gain: 1}]}}\n",
               "controllers.a.feedback[0].signal", "quantity", 3);
}

TEST(StudyControllers, WithoutASetpointThereIsNoErrorToRead) {
  const std::string push = "  push: {type: basis, output: slider_joint, coefficients: [0, 1]}\n";
  const std::string follow =
      "  follow: {type: pid, setpoint: 0, output: crank_joint, gains: {p: 1}, input: push/";
  EXPECT_EQ(
      read_text(kLeastStudy + "controllers:\n" + push + follow + "output}\n").controllers.size(),
      2U);
  expect_fault(kLeastStudy + "controllers:\n" + push + follow + "error}\n",
               "controllers.follow.input", "quantity", 5);
}

}  // namespace
}  // namespace codesign
