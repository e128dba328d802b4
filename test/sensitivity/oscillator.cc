// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/oscillator.h"

#include <string>

namespace codesign {

Problem oscillator(const std::string& lines, const std::string& amplitude) {
  const std::string urdf =
      "<robot name='oscillator' xmlns:codesign='urn:mechanism_codesign'>"
      "<codesign:parameter name='k' value='4' lower='2.56' upper='9'/><link name='ground'/>"
      "<link name='mass'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial></link>"
      "<joint name='slide' type='prismatic'><parent link='ground'/><child link='mass'/>"
      "<axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='0' velocity='0'/>"
      "<codesign:torsion_spring stiffness='4' codesign:stiffness='${k}'/></joint></robot>";
  const std::string study =
      "initial_state: {slide: {position: \"${amplitude}\"}}\n"
      "parameters: {k: {}, amplitude: " +
      amplitude +
      "}\n"
      "solver: {method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-12}\n";
  return load_problem({"oscillator.urdf", urdf}, {}, {"oscillator.yaml", study + lines});
}

}  // namespace codesign
