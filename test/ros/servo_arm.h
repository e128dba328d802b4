// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// Two bars in a vertical plane; a controller of the shoulder's position, one of the elbow's
/// velocity, and one that has no set-point.
inline Problem servo_arm() {
  const auto bar_link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><origin xyz='0 0 -0.5'/><mass value='1'/><inertia ixx='0.1' ixy='0' "
           "ixz='0' iyy='0.1' iyz='0' "
           "izz='0.01'/></inertial></link>";
  };
  const auto turning = [](const std::string& name, const std::string& parent,
                          const std::string& child, const std::string& xyz) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='0 1 0'/></joint>";
  };
  const std::string urdf = "<robot name='servo_arm'><link name='ground'/>" + bar_link("upper") +
                           bar_link("lower") + turning("shoulder", "ground", "upper", "0 0 0") +
                           turning("elbow", "upper", "lower", "0 0 -1") + "</robot>";
  const std::string study =
      "duration: 1.0\ninitial_state: {shoulder: {position: 0.2}, elbow: {position: "
      "0.1}}\ncontrollers:\n"
      "  hold: {type: pid, input: shoulder/position, setpoint: 0.2, output: shoulder, gains: {p: "
      "80.0, d: 20.0}}\n"
      "  spin: {type: pid, input: elbow/velocity, setpoint: 0.0, output: elbow, gains: {p: 8.0}}\n"
      "  damp: {type: state_feedback, output: elbow, feedback: [{signal: elbow/velocity, gain: "
      "0.1}]}\n"
      "objective: {integral: [{signal: elbow/velocity - shoulder/velocity}, {signal: "
      "hold/error}]}\n";
  return load_problem({"arm.urdf", urdf}, {}, {"arm.yaml", study});
}

}  // namespace codesign
