// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/ensemble_fixture.h"

#include <string>

namespace codesign {

const char* const kRunsAndLaws = R"(
runs: {slow: {}, fast: {initial_state: {slide: {velocity: 2.0}}}}
uncertain: {mu: {uniform: [0.2, 0.4]}, friction_law: {choice: [brown_mcphee, gonthier]}}
robust: {samples: 4}
)";

Problem block(const std::string& ensemble, const std::string& optimizer,
              const std::string& parameters) {
  const SourceText urdf{"block.urdf",
                        R"(<robot name="block" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mu" value="0.3" lower="0.1" upper="1"/>
  <codesign:parameter name="mass" value="2" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="block">
    <inertial><mass value="2" codesign:value="${mass}"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="ground"/><child link="block"/><axis xyz="1 0 0"/><limit lower="-5" upper="5" effort="100" velocity="10"/>
    <codesign:friction mu_static="0.3" codesign:mu_static="${mu}" mu_dynamic="0.3" codesign:mu_dynamic="${mu}"
      transition_velocity="0.01" joint_length="0.1" joint_width="0.1"/>
  </joint>
</robot>)"};
  const SourceText study{"block.yaml", R"(
duration: 0.8
initial_state: {slide: {velocity: 1.0}}
controllers: {hold: {type: pid, input: slide/position, setpoint: 0.5, output: slide, gains: {p: "${Kp}", d: "${Kd}"}}}
parameters: {Kp: {initial: 20.0, lower: 0.0, upper: 200.0}, Kd: {initial: 5.0, lower: 0.0, upper: 50.0})" +
                                           parameters + R"(}
objective: {integral: [{signal: slide/position, reference: 0.5, weight: 100.0}], terminal: [{signal: slide/velocity}]}
optimizer: )" + optimizer + "\n" + ensemble};
  return load_problem(urdf, {}, study);
}

}  // namespace codesign
