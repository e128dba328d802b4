// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/linear_parameters.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "identification/recorded_motion.h"

namespace codesign {
namespace {

/// A pendulum whose mass, length and damping are tuned, and the speed at which its friction is largest.
std::shared_ptr<const CompiledSystem> tunable_pendulum(const std::string& tuned) {
  return compiled(
      "<robot name='p' xmlns:codesign='urn:t'><codesign:parameter name='m' value='1'/><codesign:parameter name='l' value='0.5'/>"
      "<codesign:parameter name='c' value='0.3'/><codesign:parameter name='vt' value='0.05'/><codesign:parameter name='none' value='0'/>"
      "<link name='ground'/><link name='bar'><inertial><origin xyz='0 0 -0.5' codesign:xyz='0 ${none} ${-l}'/><mass value='1' "
      "codesign:value='${m}'/><inertia ixx='0.08' ixy='0' ixz='0' iyy='0.08' iyz='0' izz='0.08'/></inertial></link>" +
          hinge("hinge", "ground", "bar", "0 0 0",
                "<dynamics damping='0.3' codesign:damping='${c}'/><codesign:friction mu_static='0.2' mu_dynamic='0.15' "
                "transition_velocity='0.05' codesign:transition_velocity='${vt}' joint_length='0.05' pin_radius='0.02'/>") +
          "</robot>",
      let_go("{}", "hinge/velocity", "parameters: {" + tuned + "}"));
}

MotionSamples some_motion() {
  MotionSamples motion;
  for (Eigen::MatrixXd* part : {&motion.position, &motion.velocity, &motion.acceleration}) part->resize(1, 60);
  for (int k = 0; k < 60; ++k) {
    motion.position(0, k) = std::sin(0.1 * k);
    motion.velocity(0, k) = 3.0 * std::cos(0.1 * k + 0.3);
    motion.acceleration(0, k) = std::sin(0.23 * k);
  }
  return motion;
}

LinearParameters linear_of(const std::string& tuned, Status* status = nullptr) {
  const auto system = tunable_pendulum(tuned);
  EffortModel model(*system, measured({"hinge"}), thinned(some_motion(), 20));
  EXPECT_TRUE(model.begin(system->parameters()).ok());
  return find_linear_parameters(&model, system->parameters(), status);
}

TEST(LinearParameters, DampingIsAndALengthIsNot) {
  const LinearParameters found = linear_of("c: {tune: true}, l: {tune: true}, vt: {tune: true}");
  EXPECT_EQ(found.linear, std::vector<int>{0});
  EXPECT_EQ(found.others, (std::vector<int>{1, 2}));
}

TEST(LinearParameters, OfABilinearPairOneIsLeftOut) {
  const auto system = compiled(
      "<robot name='p' xmlns:codesign='urn:t'><codesign:parameter name='a' value='0.5'/><codesign:parameter name='b' value='0.6'/>"
      "<codesign:parameter name='m' value='1'/><link name='ground'/><link name='bar'><inertial><origin xyz='0 0 -0.5'/><mass value='1' "
      "codesign:value='${m}'/><inertia ixx='0.08' ixy='0' ixz='0' iyy='0.08' iyz='0' izz='0.08'/></inertial></link>" +
          hinge("hinge", "ground", "bar", "0 0 0", "<dynamics damping='0.3' codesign:damping='${a*b}'/>") + "</robot>",
      let_go("{}", "hinge/velocity", "parameters: {a: {tune: true}, b: {tune: true}, m: {tune: true}}"));
  EffortModel model(*system, measured({"hinge"}), some_motion());
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  const LinearParameters found = find_linear_parameters(&model, system->parameters());
  ASSERT_EQ(found.linear.size(), 2u);
  EXPECT_EQ(found.linear[1], 2);
  EXPECT_EQ(found.others.size(), 1u);
}

TEST(LinearParameters, AFailureAtTheStartIsReported) {
  const auto system = tunable_pendulum("m: {tune: true}");
  EffortModel model(*system, measured({"hinge"}), some_motion());
  ASSERT_TRUE(model.begin(system->parameters()).ok());
  std::vector<double> impossible = system->parameters();
  impossible[0] = -1.0;
  Status status;
  EXPECT_TRUE(find_linear_parameters(&model, impossible, &status).linear.empty());
  EXPECT_EQ(status.code, StatusCode::kInvalidDesign);
}

TEST(LinearParameters, ThinningKeepsTheFirstSampleOfEveryRecording) {
  MotionSamples motion = some_motion();
  motion.begins = {0, 25};
  const MotionSamples few = thinned(motion, 6);
  EXPECT_EQ(few.begins, (std::vector<int>{0, 3}));
  EXPECT_EQ(few.position.cols(), 7);
  EXPECT_EQ(few.position(0, 3), motion.position(0, 25));
  EXPECT_EQ(few.velocity(0, 1), motion.velocity(0, 10));
}

}  // namespace
}  // namespace codesign
