// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// A body of mass m on a slide along x, between a spring and a damper that are off by default.
/// @param study all but `initial_state`. @param velocity at the start.
inline Problem slide(const std::string& study, const std::string& velocity = "0") {
  const SourceText urdf{"slide.urdf",
                        R"(<robot name="slide" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="m" value="1" lower="0.1" upper="10"/>
  <codesign:parameter name="k" value="0" lower="0" upper="10"/>
  <codesign:parameter name="c" value="0" lower="0" upper="10"/>
  <link name="ground"/>
  <link name="body">
    <inertial><mass value="1" codesign:value="${m}"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="x" type="prismatic"><parent link="ground"/><child link="body"/><axis xyz="1 0 0"/>
    <limit lower="-1000" upper="1000" effort="100" velocity="1000"/>
    <codesign:torsion_spring stiffness="0" codesign:stiffness="${k}" damping="0" codesign:damping="${c}"/></joint>
</robot>)"};
  return load_problem(urdf, {},
                      {"slide.yaml", study + "initial_state: {x: {velocity: " + velocity + "}}\n"});
}

/// Pushed by +1 N until ts, then by -1 N: x(2) = 4 ts - ts^2 - 2, and psi = (x(2) - 2)^2 has the
/// derivative 2 (x(2) - 2) (4 - 2 ts), -6.912 at ts = 0.8.
inline Problem tuned_switch(const std::string& more = "") {
  return slide(
      "duration: 2.0\nloads: [{joint: x, effort: \"${t < ts ? 1 : -1}\"}]\n"
      "parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}\n"
      "objective: {terminal: [{signal: x/position, reference: 2.0}]}\n" +
      more);
}

}  // namespace codesign
