// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "integration/mechanisms.h"

namespace codesign {

/// A ball of 1 kg and 0.001 kg m^2 with the parameters radius = 0.05 m, loss = 0.3 s/m and mu that
/// moves freely. @param parameters further ones. @param contact the element.
inline std::string free_ball(const std::string& parameters, const std::string& contact) {
  return robot(
      "<codesign:parameter name='radius' value='0.05' lower='0.02' "
      "upper='0.1'/><codesign:parameter "
      "name='loss' value='0.3' lower='0' upper='2'/><codesign:parameter name='mu' value='0.05' "
      "lower='0' upper='1'/>" +
      parameters +
      "<link name='ball'><inertial><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' "
      "iyy='0.001' iyz='0' izz='0.001'/></inertial></link><joint name='free' "
      "type='floating'><parent "
      "link='ground'/><child link='ball'/></joint>" +
      contact);
}

/// One contact of the ball. @param on shape and numbers of the ground, @param more of the contact.
inline std::string touching_ground(const std::string& on, const std::string& more,
                                   const std::string& friction = "") {
  return "<codesign:contact name='touch' stiffness='1e6' " + more + "><predecessor link='ground' " +
         on +
         "/><successor link='ball' shape='sphere' radius='0.05' codesign:radius='${radius}'/>" +
         friction + "</codesign:contact>";
}

inline const char* const kLossy = "dissipation='0.3' codesign:dissipation='${loss}'";
inline const char* const kSlippery =
    "<codesign:friction mu_static='0.05' codesign:mu_static='${mu}' mu_dynamic='0.05' "
    "codesign:mu_dynamic='${mu}' transition_velocity='0.05'/>";

}  // namespace codesign
