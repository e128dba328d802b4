// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/planar_linkages.h"

#include <string>

#include "edited_text.h"

namespace codesign {

std::string held_in_plane(const std::string& urdf) {
  return replaced_all(urdf, "<loop ", "<loop codesign:out_of_plane='zero' ");
}

std::string block_on_a_loop(const std::string& friction) {
  return robot(
      "<codesign:parameter name='mass' value='1'/><codesign:parameter name='crank' value='0.3'/>"
      "<codesign:parameter name='pitch' value='1.3'/>" +
      replaced_all(bar("crank"), "<mass value='1'", "<mass value='1' codesign:value='${mass}'") +
      bar("rod") +
      "<link name='block'><inertial><origin xyz='0.02 0 0.01'/><mass value='0.8'/><inertia "
      "ixx='0.02' ixy='0' ixz='0.001' iyy='0.018' iyz='0' izz='0.01'/></inertial></link>" +
      hinge("crank_joint", "ground", "crank", "0 0 0") +
      "<joint name='rod_joint' type='continuous'><parent link='crank'/><child "
      "link='rod'/><origin xyz='0 0 -0.3' codesign:xyz='0 0 -${crank}'/><axis xyz='0 1 "
      "0'/></joint>" +
      hinge("block_joint", "rod", "block", "0 0 -1") +
      "<loop name='slide' type='prismatic'><predecessor link='ground'><origin xyz='0 0 -1' rpy='0 "
      "1.3 0' codesign:rpy='0 ${pitch} 0'/></predecessor><successor link='block'><origin xyz='0.05 "
      "0 0' rpy='0 0.2 0'/></successor><axis xyz='1 0 0'/>" +
      friction + "</loop>");
}

const char* slide_friction() {
  return "<codesign:friction model='brown_mcphee' mu_static='0.2' mu_dynamic='0.15' "
         "transition_velocity='0.05' joint_length='0.1' joint_width='0.06'/>";
}

const char* block_start() {
  return "{crank_joint: {position: 0.9, velocity: 1.5}, rod_joint: {guess: -0.9}, block_joint: "
         "{guess: 0.0}}";
}

std::string welded_four_bar() {
  return robot(bar("left") + bar("right") + bar("half") + bar("other") +
               hinge("left_hinge", "ground", "left", "0 0 0") +
               hinge("right_hinge", "ground", "right", "1.2 0 0") +
               hinge("left_pin", "left", "half", "0 0 -1") +
               hinge("right_pin", "right", "other", "0 0 -1") +
               "<loop name='weld' type='fixed'><predecessor link='half'><origin xyz='0 0 -0.6' "
               "rpy='0 0.3 0'/></predecessor><successor link='other'><origin xyz='0 0 0.6' rpy='0 "
               "0.3 0'/></successor></loop>");
}

const char* welded_start() {
  return "{left_hinge: {position: 0.4, velocity: 1.0}, right_hinge: {guess: 0.4}, left_pin: "
         "{guess: -1.9}, right_pin: {guess: -1.9}}";
}

std::string offset_four_bar(double centre, double pin) {
  const std::string c = std::to_string(centre), e = std::to_string(pin);
  return robot(bar("left") + bar("right") + "<link name='coupler'><inertial><origin xyz='0.6 " + c +
               " 0'/><mass value='2'/><inertia ixx='0.02' ixy='0' ixz='0' iyy='0.2' iyz='0' "
               "izz='0.2'/></inertial></link>" +
               hinge("left_hinge", "ground", "left", "0 0 0") +
               hinge("right_hinge", "ground", "right", "1.2 " + e + " 0") +
               hinge("left_pin", "left", "coupler", "0 0 -1") +
               "<loop name='right_pin' type='continuous'><predecessor link='right'><origin xyz='0 "
               "0 -1'/></predecessor><successor link='coupler'><origin xyz='1.2 " +
               e + " 0'/></successor><axis xyz='0 1 0'/></loop>");
}

}  // namespace codesign
