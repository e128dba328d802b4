// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The losses of gears and friction in N m found from motors alone: noisy positions and efforts.
#include <cmath>
#include <random>

#include "identification/identify.h"
#include "identification/simulated_recording.h"

namespace codesign {
namespace {

/// Two links; the shoulder's gear loses by torque, the elbow has friction as it is identified.
constexpr const char* kGearedArm = R"(<robot name="arm" xmlns:codesign="urn:t">
  <codesign:parameter name="efficiency" value="0.95" lower="0.3" upper="1"/>
  <codesign:parameter name="motor_coulomb" value="0.02" lower="0"/>
  <codesign:parameter name="motor_viscous" value="1e-4" lower="0"/>
  <codesign:parameter name="coulomb" value="0.5" lower="0"/>
  <codesign:parameter name="viscous" value="0.5" lower="0"/>
  <codesign:parameter name="exponent" value="1" lower="0.3" upper="1.5"/>
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0 0 -0.3"/><mass value="8"/>
    <inertia ixx="0.2" iyy="0.2" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0 -0.25"/><mass value="4"/>
    <inertia ixx="0.08" iyy="0.08" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <codesign:actuator gear_ratio="80" rotor_inertia="1e-4" efficiency="0.95" codesign:efficiency="${efficiency}"
      coulomb="0.02" codesign:coulomb="${motor_coulomb}" viscous="1e-4" codesign:viscous="${motor_viscous}"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 -0.6"/><axis xyz="0 1 0"/>
    <codesign:friction coulomb="0.5" codesign:coulomb="${coulomb}" viscous="0.5" codesign:viscous="${viscous}"
      viscous_exponent="1" codesign:viscous_exponent="${exponent}"/></joint>
</robot>)";

const char* const kGearedStudy = R"(duration: 12.0
controllers:
  s1: {type: pid, input: shoulder/position, setpoint: {type: sine, amplitude: 1.2, frequency: 0.31}, output: shoulder, gains: {p: 900.0, d: 80.0}}
  s2: {type: pid, input: elbow/position, setpoint: {type: sine, amplitude: 1.1, frequency: 0.47, phase: 0.5}, output: elbow, gains: {p: 300.0, d: 25.0}}
solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
parameters: {efficiency: {}, motor_coulomb: {}, motor_viscous: {}, coulomb: {}, viscous: {}, exponent: {}}
identify:
  data: [{csv: run.csv}]
  filter: {cutoff: 60.0, residual_cutoff: 20.0, decimate: 5}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
)";

const std::map<std::string, double> kGearedTruth = {
    {"efficiency", 0.85}, {"motor_coulomb", 0.06}, {"motor_viscous", 3e-4},
    {"coulomb", 1.4},     {"viscous", 2.0},        {"exponent", 0.7}};

void add_gear_noise(double deviation, unsigned seed, std::vector<double>* values) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  for (double& value : *values) value += normal(random);
}

TEST(GearedArm, EfficiencyAndFrictionFromMotorsAlone) {
  const Problem problem = load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", kGearedStudy});
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kGearedTruth, {"shoulder", "elbow"}, 500.0)};
  unsigned seed = 3;
  for (auto& joint : recordings.data[0].joints) {
    add_gear_noise(1e-5, seed++, &joint.position);
    add_gear_noise(1.0, seed++, &joint.effort);  // N m, of at most about 50
  }
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.numbers.size(), kGearedTruth.size());
  for (const IdentifiedNumber& number : result.numbers) {
    const double truth = kGearedTruth.at(number.name);
    const double allowed = number.name == "efficiency" ? 0.01 : 0.03 * truth;
    EXPECT_NEAR(number.value, truth, allowed) << number.name;
    EXPECT_TRUE(number.is_determined) << number.name;
  }
}

TEST(GearedArm, WithoutTheGearTheLossesAreNotExplained) {
  const Problem problem = load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", kGearedStudy});
  std::string other = kGearedStudy;
  other.replace(other.find("efficiency: {}, "), 16, "efficiency: {tune: false, initial: 1.0}, ");
  const Problem without = load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", other});
  StudyRecordings recordings;
  recordings.data = {record_run(problem, kGearedTruth, {"shoulder", "elbow"}, 500.0)};
  const IdentificationResult with_gear = identify(problem, recordings, {}, nullptr),
                             without_gear = identify(without, recordings, {}, nullptr);
  ASSERT_TRUE(with_gear.status.ok()) << with_gear.status.cause;
  ASSERT_TRUE(without_gear.status.ok()) << without_gear.status.cause;
  EXPECT_GT(without_gear.data[0].rms, 5.0 * with_gear.data[0].rms);
}

}  // namespace
}  // namespace codesign
