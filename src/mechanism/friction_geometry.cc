// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/friction_geometry.h"

namespace codesign {

void check_friction_geometry(const FrictionDescription& friction, PairKind kind, const std::string& element) {
  const auto require = [&](const Quantity& dimension, const char* name) {
    if (dimension.is_zero())  // the reader accepts only positive dimensions
      throw InputError({friction.where, element, std::string("the friction of this joint type needs the attribute ") + name, "", "> 0"});
  };
  if (friction.is_directional && slips_isotropically(kind))
    throw InputError(
        {friction.where, element, "this joint slips in several directions, none of which is backward", "",
         "mu_static_backward, mu_dynamic_backward and viscous_backward on revolute, continuous, prismatic and cylindrical joints"});
  const BearingLaw& bearing = kind->bearing;
  if (!bearing.normal_force)
    throw InputError({friction.where, element, "joints of this type have no friction law", "",
                      "friction on revolute, continuous, prismatic, cylindrical, spherical and planar joints"});
  if (bearing.joint_length) require(friction.joint_length, "joint_length");
  if (bearing.joint_width) require(friction.joint_width, "joint_width");
  if (bearing.pin_radius) require(friction.pin_radius, "pin_radius");
}

}  // namespace codesign
