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

}  // namespace
}  // namespace codesign
