// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// A pendulum with a spring-like controller, to be swung at one radian per second: two parameters
/// to tune, a third that could be.
inline const std::string kPendulumUrdf =
    R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="0.5" lower="0.3" upper="0.8" unit="m"/>
  <codesign:parameter name="mass" value="1" lower="0.5" upper="2" unit="kg"/>
  <link name="ground"/>
  <link name="bob">
    <inertial>
      <origin xyz="0 0 -0.5" codesign:xyz="0 0 ${-length}"/>
      <mass value="1" codesign:value="${mass}"/>
      <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/>
    </inertial>
  </link>
  <joint name="hinge" type="continuous">
    <parent link="ground"/>
    <child link="bob"/>
    <axis xyz="0 1 0"/>
  </joint>
</robot>
)";

inline const std::string kPendulumStudy = R"(duration: 0.5
initial_state: {hinge: {position: 0.5, velocity: 0.0}}
controllers:
  hold: {type: pid, input: hinge/position, setpoint: 0.0, output: hinge, gains: {p: "${Kp}"}}
parameters:
  length: {}
  Kp: {initial: 1.0, lower: 0.0, upper: 5.0}
objective:
  integral: [{signal: hinge/velocity, reference: -1.0}]
solver: {relative_tolerance: 1.0e-6, absolute_tolerance: 1.0e-7}
optimizer: {algorithm: lbfgs, max_evaluations: 30}
)";

inline Problem pendulum() {
  return load_problem({"pendulum.urdf", kPendulumUrdf}, {}, {"pendulum.yaml", kPendulumStudy});
}

}  // namespace codesign
