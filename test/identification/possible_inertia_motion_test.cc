// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A fit of simulated motion whose true inertia is a point, on the border of the possible ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "identification/identify.h"
#include "identification/simulated_recording.h"

namespace codesign {
namespace {

std::string two_links(const std::string& fore) {
  return R"(<robot name="two" xmlns:codesign="https://mechanism-codesign.org">
  <link name="ground"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial></link>
  <link name="fore"><inertial)" +
         fore + R"(</inertial></link>
  <joint name="one" type="continuous"><parent link="ground"/><child link="upper"/><axis xyz="0 1 0"/></joint>
  <joint name="two" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0" rpy="0.4 0 0"/>
    <axis xyz="0 1 0.3"/></joint>
</robot>)";
}

/// A point of 1 kg at 0.3 m.
const std::string kPoint =
    R"(><origin xyz="0.3 0 0"/><mass value="1"/><inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/>)";
const std::string kBar =
    R"( codesign:inertia="free"><origin xyz="0.2 0 0"/><mass value="1.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/>)";
constexpr double kNoise = 1e-3;

TEST(PossibleInertiaMotion, EndsAtItsOptimumOnTheBorder) {
  const Problem truth =
      load_problem({"true.urdf", two_links(kPoint)}, {}, {"truth.yaml", R"(duration: 4.0
controllers:
  s1: {type: pid, input: one/position, setpoint: "${0.8*sin(2.1*t) + 0.3*sin(5*t)}", output: one, gains: {p: 60, d: 6}}
  s2: {type: pid, input: two/position, setpoint: "${0.7*sin(3.1*t) + 0.4*sin(1.3*t)}", output: two, gains: {p: 30, d: 2}}
solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}
)"});
  StudyRecordings recordings;
  recordings.data = {record_run(truth, {}, {"one", "two"}, 200.0)};
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise);
  for (JointSamples& joint : recordings.data[0].joints)
    for (double& position : joint.position) position += noise(random);
  std::string numbers;
  for (const char* number : {"alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3"})
    numbers += std::string("fore_") + number + ": {}, ";
  const Problem problem = load_problem(
      {"start.urdf", two_links(kBar)}, {},
      {"fit.yaml",
       "identify: {data: [{csv: run.csv}], residual: motion, segment: 1.0, filter: {cutoff: 20}}\n"
       "parameters: {" +
           numbers + "}\n"});
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_TRUE(result.termination == "success" ||
              result.termination == "objective_tolerance_reached")
      << result.termination;
  EXPECT_LE(result.evaluations, 40);
  for (const OutputFit& fit : result.data) EXPECT_NEAR(fit.rms, kNoise, 0.05 * kNoise) << fit.joint;
  EXPECT_NEAR(result.numbers[0].value, 0.0, 1e-3) << "half the logarithm of 1 kg";
  EXPECT_NEAR(result.numbers[7].value, 0.3, 1e-3);
}

}  // namespace
}  // namespace codesign
