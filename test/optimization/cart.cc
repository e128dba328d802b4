// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/cart.h"

namespace codesign {

SourceText cart_urdf() {
  return {"cart.urdf", R"(<robot name="cart" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="cart"><inertial><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-5" upper="5" effort="100" velocity="10"/></joint>
</robot>)"};
}

}  // namespace codesign
