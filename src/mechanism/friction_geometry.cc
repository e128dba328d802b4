// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/friction_geometry.h"

namespace codesign {

void check_friction_geometry(const FrictionDescription& friction, JointType type, const std::string& element) {
  const auto require = [&](const Quantity& dimension, const char* name) {
    if (dimension.is_zero())  // the reader accepts only positive dimensions
      throw InputError({friction.where, element, std::string("the friction of this joint type needs the attribute ") + name, "", "> 0"});
  };
  if (friction.is_directional && (type == JointType::kSpherical || type == JointType::kPlanar))
    throw InputError(
        {friction.where, element, "this joint slips in several directions, none of which is backward", "",
         "mu_static_backward, mu_dynamic_backward and viscous_backward on revolute, continuous, prismatic and cylindrical joints"});
  switch (type) {
    case JointType::kPrismatic:
      require(friction.joint_length, "joint_length");
      require(friction.joint_width, "joint_width");
      return;
    case JointType::kRevolute:
    case JointType::kContinuous:
    case JointType::kCylindrical:
      require(friction.joint_length, "joint_length");
      require(friction.pin_radius, "pin_radius");
      return;
    case JointType::kSpherical:
      require(friction.pin_radius, "pin_radius");
      return;
    case JointType::kPlanar:
      return;
    case JointType::kFixed:
    case JointType::kFloating:
    case JointType::kUniversal:
    case JointType::kDistance:
      break;
  }
  throw InputError({friction.where, element, "joints of this type have no friction law", "",
                    "friction on revolute, continuous, prismatic, cylindrical, spherical and planar joints"});
}

}  // namespace codesign
