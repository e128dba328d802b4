// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/arm.h"

#include <string>

namespace codesign {

std::string crane(const std::string& more) {
  const auto link = [](const std::string& name, const std::string& centre,
                       const std::string& mass) {
    return "<link name='" + name + "'><inertial><origin xyz='" + centre +
           "' rpy='0.1 0.2 0.3'/><mass value='" + mass +
           "'/><inertia ixx='0.03' ixy='0.001' ixz='0.002' iyy='0.025' iyz='0.001' "
           "izz='0.02'/></inertial></link>";
  };
  const auto joint = [](const std::string& name, const std::string& type, const std::string& parent,
                        const std::string& child, const std::string& origin,
                        const std::string& axis) {
    return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='" + axis + "'/>" +
           (type == "prismatic" ? "<limit effort='1' velocity='1'/>" : "") + "</joint>";
  };
  return "<robot name='crane' xmlns:codesign='urn:test'><link name='ground'/>" +
         link("trolley", "0.02 0.01 0", "3") + link("mast", "0.05 0 0.3", "2") +
         link("boom", "0.3 0.02 0", "1.5") + link("gripper", "0.1 0 -0.2", "0.7") +
         link("bob", "0 0.01 -0.1", "0.4") + "<link name='a'/><link name='b'/>" +
         joint("travel", "prismatic", "ground", "trolley", "xyz='0 0 1' rpy='0.1 0 0'", "1 0 0") +
         joint("turn", "continuous", "trolley", "mast", "xyz='0.1 0 0.2' rpy='0 0.2 0'", "0 0 1") +
         joint("reach", "prismatic", "mast", "boom", "xyz='0.1 0 0.5' rpy='0 0.3 0'", "1 0 0.2") +
         joint("wrist", "continuous", "boom", "gripper", "xyz='0.6 0 0' rpy='0.3 0 0'", "0 1 0") +
         joint("ball_x", "continuous", "boom", "a", "xyz='0.3 0 -0.1'", "1 0 0") +
         joint("ball_y", "continuous", "a", "b", "xyz='0 0 0'", "0 1 0") +
         joint("ball_z", "continuous", "b", "bob", "xyz='0 0 0'", "0 0 1") + more + "</robot>";
}

}  // namespace codesign
