// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "identification/simulated_recording.h"

namespace codesign {

/// Two links; the shoulder's gear loses by torque, the elbow has friction as it is identified.
inline constexpr const char* kGearedArm = R"(<robot name="arm" xmlns:codesign="urn:t">
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

/// @param data of the recording, an entry of `identify.data`.
inline std::string geared_study(const std::string& data = "{csv: run.csv}") {
  return R"(duration: 60.0
controllers:
  s1: {type: pid, input: shoulder/position, setpoint: {type: sine, amplitude: 1.2, frequency: 0.31}, output: shoulder, gains: {p: 900.0, d: 80.0}}
  s2: {type: pid, input: elbow/position, setpoint: {type: sine, amplitude: 1.1, frequency: 0.47, phase: 0.5}, output: elbow, gains: {p: 300.0, d: 25.0}}
solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
parameters: {efficiency: {}, motor_coulomb: {}, motor_viscous: {}, coulomb: {}, viscous: {}, exponent: {}}
identify:
  data: [)" +
         data + R"(]
  filter: {cutoff: 60.0, residual_cutoff: 20.0, decimate: 5}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
)";
}

inline const std::map<std::string, double> kGearedTruth = {
    {"efficiency", 0.85}, {"motor_coulomb", 0.06}, {"motor_viscous", 3e-4},
    {"coulomb", 1.4},     {"viscous", 2.0},        {"exponent", 0.7}};

inline void add_gear_noise(double deviation, unsigned seed, std::vector<double>* values) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  for (double& value : *values) value += normal(random);
}

/// The recording with noise of the encoders [rad] and of the torque of the motors, 3 % of its root
/// mean square [N m].
inline JointRecording with_noise(JointRecording recording, unsigned seed) {
  for (JointSamples& joint : recording.joints) {
    add_gear_noise(1e-5, seed++, &joint.position);
    add_gear_noise(0.5, seed++, &joint.effort);
  }
  return recording;
}

inline Problem geared_problem(const std::string& data = "{csv: run.csv}") {
  return load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", geared_study(data)});
}

/// What the motors of the true arm record without noise.
inline JointRecording clean_geared_recording() {
  return record_run(geared_problem(), kGearedTruth, {"shoulder", "elbow"}, 500.0);
}

/// Friction of motor and gear at the shoulder, and of the elbow, at a speed [N m].
inline std::pair<double, double> gear_friction(const std::map<std::string, double>& numbers,
                                               double speed) {
  return {80.0 * (numbers.at("motor_coulomb") + 80.0 * speed * numbers.at("motor_viscous")),
          numbers.at("coulomb") + numbers.at("viscous") * std::pow(speed, numbers.at("exponent"))};
}

/// The efficiency within 0.01 and all friction within 3 %, over the speeds of the recording from
/// one tenth of the largest on. The numbers of a friction curve alone are known less well: one
/// makes up for the other.
inline void expect_geared_truth(const std::map<std::string, double>& found,
                                const std::string& what) {
  EXPECT_NEAR(found.at("efficiency"), kGearedTruth.at("efficiency"), 0.01) << what;
  for (const auto& [name, truth] : kGearedTruth)
    EXPECT_NEAR(found.at(name) / truth, 1.0, 0.05) << what << ", " << name;
  for (const double speed : {0.3, 0.6, 1.2, 2.3}) {
    const auto [motor, elbow] = gear_friction(found, speed);
    const auto [true_motor, true_elbow] = gear_friction(kGearedTruth, speed);
    EXPECT_NEAR(motor / true_motor, 1.0, 0.03) << what << ", shoulder at " << speed;
    EXPECT_NEAR(elbow / true_elbow, 1.0, 0.03) << what << ", elbow at " << speed;
  }
}

}  // namespace codesign
