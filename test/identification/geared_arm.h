// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
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
      coulomb="0.02" codesign:coulomb="${motor_coulomb}" viscous="1e-4" codesign:viscous="${motor_viscous}"
      transition_velocity="0.01"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 -0.6"/><axis xyz="0 1 0"/>
    <codesign:friction coulomb="0.5" codesign:coulomb="${coulomb}" viscous="0.5" codesign:viscous="${viscous}"
      viscous_exponent="1" codesign:viscous_exponent="${exponent}" transition_velocity="0.01"/></joint>
</robot>)";

/// @param data of the recording, an entry of `identify.data`.
std::string geared_study(const std::string& data = "{csv: run.csv}");

inline const std::map<std::string, double> kGearedTruth = {
    {"efficiency", 0.85}, {"motor_coulomb", 0.06}, {"motor_viscous", 3e-4},
    {"coulomb", 1.4},     {"viscous", 2.0},        {"exponent", 0.7}};

void add_gear_noise(double deviation, unsigned seed, std::vector<double>* values);

/// The recording with noise of the encoders [rad] and of the torque of the motors, 3 % of its root
/// mean square [N m].
JointRecording with_noise(JointRecording recording, unsigned seed);

Problem geared_problem(const std::string& data = "{csv: run.csv}");

/// What the motors of the true arm record without noise.
JointRecording clean_geared_recording();

/// Friction of motor and gear at the shoulder, and of the elbow, at a speed [N m].
std::pair<double, double> gear_friction(const std::map<std::string, double>& numbers, double speed);

/// The efficiency within 0.01 and all friction within 3 %, over the speeds of the recording from
/// one tenth of the largest on. The numbers of a friction curve alone are known less well: one
/// makes up for the other.
void expect_geared_truth(const std::map<std::string, double>& found, const std::string& what);

}  // namespace codesign
