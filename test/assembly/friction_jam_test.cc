// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/friction_jam.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"

namespace codesign {
namespace {

/// A slide with friction of `mu`, which carries a bar that leans forward; with a hinge on another
/// axis that rubs, too.
std::string leaning_bar(double mu) {
  const auto mass = [](const std::string& at, const std::string& kg, const std::string& moment) {
    return "<inertial><origin xyz='" + at + "'/><mass value='" + kg + "'/><inertia ixx='" + moment +
           "' ixy='0' ixz='0' iyy='" + moment + "' iyz='0' izz='" + moment + "'/></inertial>";
  };
  return robot("<link name='slider'>" + mass("0 0 0", "0.1", "0.001") + "</link><link name='bar'>" +
               mass("0.2 0 0.25", "1", "1e-6") + "</link>" + bar("beside") +
               "<joint name='rail' type='prismatic'><parent link='ground'/><child "
               "link='slider'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='9' "
               "velocity='9'/><codesign:friction model='stribeck' mu_static='" +
               std::to_string(mu) + "' mu_dynamic='" + std::to_string(mu) +
               "' transition_velocity='0.001' joint_length='10' joint_width='10'/></joint>" +
               hinge("pivot", "slider", "bar", "0 0 0") +
               hinge("pin", "ground", "beside", "0 2 0", pin_friction()));
}

// Painleve's paradox: pushed along, the bar presses the slider the harder on its rail the more it
// rubs.
TEST(FrictionJam, NamesTheJointThatSlidesAndWhatHelps) {
  Compiled jammed(leaning_bar(1.5), "duration: 0.2\ninitial_state: {rail: {velocity: -1}}\n");
  const Status status = jammed.start();
  ASSERT_EQ(status.code, StatusCode::kInitialReactionsFailed) << status.cause;
  for (const char* part : {"'rail'", "jam", "mu_static", "joint_length"})
    EXPECT_NE(status.cause.find(part), std::string::npos) << status.cause;
  EXPECT_EQ(status.cause.find("'pin'"), std::string::npos) << "it rests: " << status.cause;
  Compiled slides(leaning_bar(0.2), "duration: 0.2\ninitial_state: {rail: {velocity: -1}}\n");
  EXPECT_TRUE(slides.start().ok());
}

TEST(FrictionJam, IfNothingSlidesAllThatRubsIsNamed) {
  Compiled c(leaning_bar(0.2), "duration: 0.2\n");
  ASSERT_TRUE(c.start().ok());
  EXPECT_EQ(rubbing_joints(c.system, c.state, &c.equations), "'rail', 'pin'");
  Compiled smooth(pendulum(), "duration: 0.2\n");
  ASSERT_TRUE(smooth.start().ok());
  EXPECT_EQ(jam_advice(smooth.system, smooth.state, &smooth.equations), "");
}

}  // namespace
}  // namespace codesign
