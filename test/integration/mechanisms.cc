// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/mechanisms.h"

#include <string>

#include "edited_text.h"

namespace codesign {

std::string bar(const std::string& name) {
  return "<link name='" + name +
         "'><inertial><origin xyz='0 0 -0.5'/><mass value='1'/>"
         "<inertia ixx='0.0834' ixy='0' ixz='0' iyy='0.0834' iyz='0' "
         "izz='0.001'/></inertial></link>";
}

std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& xyz, const std::string& friction) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='0 1 0'/>" +
         friction + "</joint>";
}

std::string robot(const std::string& content) {
  return "<robot name='test' xmlns:codesign='https://github.com/mechanism_codesign'><link "
         "name='ground'/>" +
         content + "</robot>";
}

const char* pin_friction() {
  return "<codesign:friction model='brown_mcphee' mu_static='0.2' mu_dynamic='0.15' "
         "transition_velocity='0.01' joint_length='0.05' "
         "pin_radius='0.02'/>";
}

std::string with_friction_model(const std::string& urdf, const std::string& model) {
  return replaced_all(urdf, "<codesign:friction( model='brown_mcphee')?",
                      "<codesign:friction model='" + model + "'");
}

std::string pendulum(const std::string& friction) {
  return robot(bar("bar") + hinge("hinge", "ground", "bar", "0 0 0", friction));
}

std::string double_pendulum(const std::string& friction) {
  return robot(bar("upper") + bar("lower") +
               hinge("shoulder", "ground", "upper", "0 0 0", friction) +
               hinge("elbow", "upper", "lower", "0 0 -1", friction));
}

std::string four_bar(const std::string& friction) {
  return robot(
      bar("left") + bar("right") + bar("coupler") +
      hinge("left_hinge", "ground", "left", "0 0 0", friction) +
      hinge("right_hinge", "ground", "right", "1.2 0 0") +
      "<joint name='left_pin' type='continuous'><parent link='left'/><child "
      "link='coupler'/><origin xyz='0 0 -1' rpy='0 "
      "-1.5707963267948966 0'/>"
      "<axis xyz='0 1 0'/></joint>"
      "<loop name='right_pin' type='continuous'><predecessor link='right'><origin xyz='0 0 "
      "-1'/></predecessor>"
      "<successor link='coupler'><origin xyz='0 0 -1.2'/></successor><axis xyz='0 1 0'/></loop>");
}

std::string puck() {
  return robot(
      "<link name='puck'><inertial><mass value='2'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' "
      "iyz='0' izz='0.02'/></inertial></link>" +
      bar("bar") +
      "<joint name='slope' type='planar'><parent link='ground'/><child link='puck'/><origin xyz='0 "
      "0 0' rpy='0 0.6 0'/><axis xyz='0 0 1'/>"
      "<codesign:friction mu_static='0.3' mu_dynamic='0.2' transition_velocity='0.01' "
      "pin_radius='0.08'/></joint>" +
      "<joint name='hinge' type='continuous'><parent link='puck'/><child link='bar'/><origin "
      "xyz='0 0.1 0'/><axis xyz='0 1 0'/></joint>");
}

std::string ball_pendulum() {
  const auto turn = [](const std::string& name, const std::string& parent, const std::string& child,
                       const std::string& axis, const std::string& more) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><axis xyz='" + axis + "'/>" + more + "</joint>";
  };
  return robot("<link name='a'/><link name='b'/>" + bar("bar") +
               turn("ball_x", "ground", "a", "1 0 0",
                    "<codesign:friction mu_static='0.3' mu_dynamic='0.2' "
                    "transition_velocity='0.01' pin_radius='0.03'/>") +
               turn("ball_y", "a", "b", "0 1 0", "") + turn("ball_z", "b", "bar", "0 0 1", ""));
}

std::string spring_pendulum() {
  return robot(bar("bar") + hinge("hinge", "ground", "bar", "0 0 0") +
               "<codesign:spring_damper name='spring' stiffness='40' "
               "free_length='0.5'><predecessor link='ground'><origin xyz='1 0.2 "
               "-0.3'/></predecessor>"
               "<successor link='bar'><origin xyz='0 0 -1'/></successor></codesign:spring_damper>");
}

std::string motion_study(double duration, const std::string& initial, const std::string& signal,
                         const std::string& solver) {
  return "duration: " + std::to_string(duration) + "\ninitial_state: " + initial +
         "\ncontrollers: {}\nparameters: {}\nobjective: {integral: [{signal: " + signal +
         "}], terminal: []}\nsolver: " + solver +
         "\noptimizer: {algorithm: lbfgs, max_evaluations: 10, relative_tolerance: 1.0e-6}\n";
}

}  // namespace codesign
