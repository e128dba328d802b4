// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// The problem of a model with clearance and a study.
inline Problem playing_problem(const std::string& urdf, const std::string& study) {
  return load_problem({"playing.urdf", urdf}, {}, {"playing.yaml", study}, {}, TrajectoryLoader(),
                      FileLoader());
}

/// The clearance of the pins of playing_slider_crank().
inline const char* const kPlayingPin =
    "<codesign:clearance radial='5e-4' codesign:radial='${c}' radius='0.01' stiffness='2e7' "
    "dissipation='0.3' codesign:dissipation='${loss}'><codesign:friction mu_static='0.1' "
    "mu_dynamic='0.1' transition_velocity='0.05'/></codesign:clearance>";

/// A slider-crank in the plane z = 0 with the lengths and masses of Flores, Ambrosio, Claro and
/// Lankarani (2007) and the parameters c, loss and the crank's length l1.
/// @param elbow, pin parts of the joint between crank and rod, and of the loop between rod and
/// slider.
inline std::string playing_slider_crank(const std::string& elbow, const std::string& pin) {
  const auto inertia = [](const std::string& I) {
    return "<inertia ixx='" + I + "' ixy='0' ixz='0' iyy='" + I + "' iyz='0' izz='" + I +
           "'/></inertial></link>";
  };
  return "<robot name='playing' xmlns:codesign='urn:mechanism_codesign'>"
         "<codesign:parameter name='c' value='5e-4'/><codesign:parameter name='loss' value='0.3'/>"
         "<codesign:parameter name='l1' value='0.05'/><link name='ground'/>"
         "<link name='crank'><inertial><origin xyz='0.025 0 0'/><mass value='0.3'/>" +
         inertia("1e-4") +
         "<link name='rod'><inertial><origin xyz='0.06 0 0'/><mass value='0.21'/>" +
         inertia("2.5e-4") + "<link name='slider'><inertial><mass value='0.14'/>" +
         inertia("1e-4") +
         "<joint name='turn' type='continuous'><parent link='ground'/><child link='crank'/><axis "
         "xyz='0 0 1'/></joint><joint name='elbow' type='continuous'><parent link='crank'/><child "
         "link='rod'/><origin xyz='0.05 0 0' codesign:xyz='${l1} 0 0'/><axis xyz='0 0 1'/>" +
         elbow +
         "</joint><joint name='guide' type='prismatic'><parent link='ground'/><child "
         "link='slider'/><axis xyz='1 0 0'/><limit lower='-1' upper='1' effort='0' "
         "velocity='0'/></joint><loop name='pin' type='revolute'><predecessor link='rod'><origin "
         "xyz='0.12 0 0'/></predecessor><successor link='slider'/><axis xyz='0 0 1'/>" +
         pin + "</loop></robot>";
}

/// It runs freely from a turning crank. @param more lines of the study
inline std::string playing_study(const std::string& more) {
  return "gravity: [0, 0, 0]\nduration: 0.03\ninitial_state: {turn: {position: 0.5, velocity: "
         "30.0}, elbow: {guess: -0.7}}\nparameters: {c: {}, loss: {}, l1: {}}\nobjective: "
         "{terminal: [{signal: slider/position/x, reference: 0.1}, {signal: turn/velocity, weight: "
         "0.001}], integral: [{signal: slider/velocity/x}]}\n" +
         more;
}

}  // namespace codesign
