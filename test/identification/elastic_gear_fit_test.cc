// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Stiffness, damping and play of a gear from the motion of its joint under the motor's torque.
#include <gtest/gtest.h>

#include "identification/identify.h"
#include "identification/simulated_recording.h"

namespace codesign {
namespace {

std::string yielding_arm(const std::string& more) {
  return R"(<robot name="arm" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="stiffness" value="250" lower="10" upper="5000"/>
  <codesign:parameter name="damping" value="1" lower="0" upper="100"/>
  <codesign:parameter name="play" value="0.01" lower="0.0001" upper="0.1"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
    <dynamics damping="0.3" friction="0"/>
    <codesign:actuator gear_ratio="20" rotor_inertia="5e-4" viscous="1e-4" stiffness="250"
      codesign:stiffness="${stiffness}" damping="1" codesign:damping="${damping}")" +
         more + R"(/></joint>
</robot>)";
}

IdentificationResult fitted(const std::string& urdf, const std::string& parameters,
                            const std::map<std::string, double>& truth) {
  const std::string torque =
      "duration: 4\ncontrollers: {motor: {type: state_feedback, output: hinge, feedforward: "
      "\"${6*sin(5*t) + 4*sin(17*t)}\"}}\nparameters: {" +
      parameters + "}\n";
  const Problem bench = load_problem({"arm.urdf", urdf}, {}, {"bench.yaml", torque});
  StudyRecordings recordings;
  recordings.data = {record_run(bench, truth, {"hinge"}, 500.0)};
  const Problem problem = load_problem(
      {"arm.urdf", urdf}, {},
      {"study.yaml", "identify: {residual: motion, segment: 1.0}\nparameters: {" + parameters +
                         "}\noptimizer: {algorithm: levenberg_marquardt}\n"});
  return identify(problem, recordings, {}, nullptr);
}

TEST(ElasticGearFit, FindsStiffnessAndDamping) {
  const std::map<std::string, double> truth = {{"stiffness", 400.0}, {"damping", 2.0}};
  const IdentificationResult result = fitted(yielding_arm(""), "stiffness: {}, damping: {}", truth);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  for (const IdentifiedNumber& number : result.numbers)
    EXPECT_NEAR(number.value, truth.at(number.name), 1e-3 * truth.at(number.name)) << number.name;
  EXPECT_GT(result.data[0].explained, 1.0 - 1e-6);
}

TEST(ElasticGearFit, FindsPlay) {
  const std::map<std::string, double> truth = {{"stiffness", 400.0}, {"play", 0.03}};
  const IdentificationResult result =
      fitted(yielding_arm(" backlash=\"0.01\" codesign:backlash=\"${play}\""),
             "stiffness: {}, play: {}", truth);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  for (const IdentifiedNumber& number : result.numbers)
    EXPECT_NEAR(number.value, truth.at(number.name), 1e-2 * truth.at(number.name)) << number.name;
}

}  // namespace
}  // namespace codesign
