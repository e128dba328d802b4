// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/mechanisms.h"

namespace codesign {

// Loops whose pin turns as far as the crank, about parallel axes. Without gravity.

/// A parallelogram with cranks of 0.1 m, 0.3 m apart; `pin` joins its coupler to the second crank.
/// Speeds do not change, since the coupler moves on a circle without turning. Twice in a turn it is
/// flat, a singular position.
inline std::string turning_parallelogram() {
  const auto link = [](const std::string& name, const std::string& centre) {
    return "<link name='" + name + "'><inertial><origin xyz='" + centre +
           "'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.001' iyz='0' "
           "izz='0.001'/></inertial></link>";
  };
  return robot(
      "<codesign:parameter name='k' value='0.001'/>" + link("left", "0 0 0.05") +
      link("coupler", "0.1 0 0") + link("right", "0 0 0.05") +
      hinge("crank", "ground", "left", "0 0 0") + hinge("knee", "left", "coupler", "0 0 0.1") +
      hinge("follower", "ground", "right", "0.3 0 0") +
      "<loop name='pin' type='revolute' codesign:out_of_plane='zero'><predecessor link='coupler'>"
      "<origin xyz='0.3 0 0'/></predecessor><successor link='right'><origin xyz='0 0 0.1'/>"
      "</successor><axis xyz='0 1 0'/></loop>");
}

/// A rotor that carries two crossed slides; the outer one turns in a bearing of the ground in the
/// axis of the crank, loop `pin`, which holds both slides in their middle. No position is singular,
/// and all rotate as far as the crank. @param more elements of the loop.
inline std::string rotor_with_slides(const std::string& more = "") {
  const auto link = [](const std::string& name, const std::string& inertia) {
    return "<link name='" + name + "'><inertial><mass value='1'/><inertia ixx='0.01' ixy='0' " +
           "ixz='0' iyy='" + inertia + "' iyz='0' izz='0.01'/></inertial></link>";
  };
  const auto slide = [](const std::string& parent, const std::string& child,
                        const std::string& axis) {
    return "<joint name='" + child + "_slide' type='prismatic'><parent link='" + parent +
           "'/><child link='" + child + "'/><axis xyz='" + axis +
           "'/><limit lower='-9' upper='9' effort='9' velocity='9'/></joint>";
  };
  return robot("<codesign:parameter name='k' value='0.001'/>" + link("rotor", "0.007") +
               link("middle", "0.005") + link("outer", "0.005") +
               hinge("crank", "ground", "rotor", "0 0 0") + slide("rotor", "middle", "1 0 0") +
               slide("middle", "outer", "0 0 1") +
               "<loop name='pin' type='revolute' codesign:out_of_plane='zero'><predecessor "
               "link='ground'/><successor link='outer'/><axis xyz='0 1 0'/>" +
               more + "</loop>");
}
constexpr double kRotorInertia = 0.017;  // [kg m^2]

/// A torsion spring of k [N m/rad] on the pin, too weak to shorten the steps.
inline const char* pin_spring() {
  return "<codesign:torsion_spring stiffness='0.001' codesign:stiffness='${k}'/>";
}

}  // namespace codesign
