// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/controller_constants.h"

#include <gtest/gtest.h>

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(ControllerConstants, EveryNumberOfALawIsEvaluatedAtTheDesign) {
  const Study study = read_text(
      kLeastStudy +
      "parameters: {k: {initial: 2.0}}\n"
      "controllers:\n"
      "  speed: {type: pid, input: crank_joint/velocity, setpoint: \"${3*k}\", output: crank_joint, gains: {p: \"${k}\", d: 0.5}}\n"
      "  hold: {type: state_feedback, output: slider_joint, feedforward: \"${k}\",\n"
      "         feedback: [{signal: slider_joint/position, gain: \"${k*k}\", reference: 0.1}]}\n"
      "  push: {type: basis, output: slider_joint, coefficients: [1.0, \"${k + rod_length}\"]}\n");
  std::vector<double> parameters;
  for (const Parameter& parameter : study.parameters) parameters.push_back(parameter.name == "k" ? 5.0 : parameter.value);
  const ControllerConstants<double> speed = controller_constants(study.controllers.at(0), parameters);
  EXPECT_EQ(speed.setpoint.at(0.0).value, 15.0);
  EXPECT_EQ(speed.pid.p, 5.0);
  EXPECT_EQ(speed.pid.i, 0.0);
  EXPECT_EQ(speed.pid.d, 0.5);
  const ControllerConstants<double> hold = controller_constants(study.controllers.at(1), parameters);
  EXPECT_EQ(hold.feedforward.at(0.0).value, 5.0);
  EXPECT_EQ(hold.gains, std::vector<double>{25.0});
  EXPECT_EQ(hold.references.at(0).at(1.0).value, 0.1);
  EXPECT_EQ(controller_constants(study.controllers.at(2), parameters).shape.coefficients(), (std::vector<double>{1.0, 5.3}));
}

TEST(ControllerConstants, ImpossibleNumbersOfADesignAreNamed) {
  const Study study =
      read_text(kLeastStudy +
                "parameters: {k: {initial: 2.0}}\ncontrollers:\n  speed: {type: pid, input: crank_joint/velocity, setpoint: 0, "
                "output: crank_joint, gains: {p: 1, i: 1, d: 1}, i_clamp: \"${k}\", output_limit: \"${2*k}\", derivative_filter: "
                "\"${k}\", time_constant: \"${k/2}\"}\n");
  std::vector<double> parameters;
  for (const Parameter& parameter : study.parameters) parameters.push_back(parameter.value);
  const ControllerDescription& description = study.controllers.at(0);
  ControllerConstants<double> constants = controller_constants(description, parameters);
  EXPECT_EQ(constants.i_clamp, 2.0);
  EXPECT_EQ(constants.output_limit, 4.0);
  EXPECT_EQ(constants.derivative_filter, 2.0);
  EXPECT_EQ(constants.time_constant, 1.0);
  EXPECT_EQ(find_impossible(description, constants), "");
  constants.time_constant = -1.0;
  EXPECT_EQ(find_impossible(description, constants), "controllers.speed.time_constant is -1, it must be positive");
  constants.i_clamp = 0.0;
  EXPECT_NE(find_impossible(description, constants).find("i_clamp is 0"), std::string::npos);
}

}  // namespace
}  // namespace codesign
