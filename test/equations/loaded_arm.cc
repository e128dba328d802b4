// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/loaded_arm.h"

#include <string>

namespace codesign {

std::string loaded_hinge(const std::string& name, const std::string& parent,
                         const std::string& child, const std::string& xyz) {
  return "<joint name='" + name + "' type='revolute'><parent link='" + parent + "'/><child link='" +
         child + "'/><origin xyz='" + xyz +
         "'/><axis xyz='0.2 1 0'/><limit lower='-0.1' upper='0.05' effort='3' "
         "velocity='1'/><dynamics damping='0.3' friction='0.2'/>" +
         pin_friction() +
         "<codesign:torsion_spring stiffness='2' damping='0.1' "
         "free_position='0.3'/><codesign:actuator gear_ratio='7' "
         "rotor_inertia='0.002'/></joint>";
}

std::string loaded_arm() {
  return robot(bar("upper") + bar("lower") + loaded_hinge("shoulder", "ground", "upper", "0 0 0") +
               loaded_hinge("elbow", "upper", "lower", "0 0 -1") +
               "<codesign:spring_damper name='spring' stiffness='40' damping='3' "
               "free_length='0.5'><predecessor link='ground'><origin xyz='1 "
               "0.2 -0.3'/></predecessor><successor link='lower'><origin xyz='0 0.1 "
               "-1'/></successor></codesign:spring_damper>");
}

}  // namespace codesign
