// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/mechanisms.h"

namespace codesign {

// Loops whose pin turns as far as the crank, about parallel axes. Without gravity.

/// A bar of 1/3 kg m^2 (0.0834 + 0.25) about its crank, with a second bearing in the same axis as
/// loop `pin`. @param more elements of the loop.
inline std::string two_bearings(const std::string& more = "") {
  return robot(
      "<codesign:parameter name='k' value='0.3334'/>" + bar("rotor") +
      hinge("crank", "ground", "rotor", "0 0 0") +
      "<loop name='pin' type='revolute' codesign:out_of_plane='zero'><predecessor link='ground'/>"
      "<successor link='rotor'/><axis xyz='0 1 0'/>" +
      more + "</loop>");
}

/// A parallelogram with cranks of 0.1 m, 0.3 m apart; `pin` joins its coupler to the second crank.
/// Speeds do not change, since the coupler moves on a circle without turning.
inline std::string turning_parallelogram(const std::string& more = "") {
  const auto link = [](const std::string& name, const std::string& centre) {
    return "<link name='" + name + "'><inertial><origin xyz='" + centre +
           "'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.001' iyz='0' "
           "izz='0.001'/></inertial></link>";
  };
  return robot(
      "<codesign:parameter name='k' value='0.002'/>" + link("left", "0 0 0.05") +
      link("coupler", "0.1 0 0") + link("right", "0 0 0.05") +
      hinge("crank", "ground", "left", "0 0 0") + hinge("knee", "left", "coupler", "0 0 0.1") +
      hinge("follower", "ground", "right", "0.3 0 0") +
      "<loop name='pin' type='revolute' codesign:out_of_plane='zero'><predecessor link='coupler'>"
      "<origin xyz='0.3 0 0'/></predecessor><successor link='right'><origin xyz='0 0 0.1'/>"
      "</successor><axis xyz='0 1 0'/>" +
      more + "</loop>");
}

/// A torsion spring of k [N m/rad] on the pin.
inline const char* pin_spring() {
  return "<codesign:torsion_spring stiffness='1' codesign:stiffness='${k}'/>";
}

}  // namespace codesign
