// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/statics_cases.h"

#include <string>
#include <vector>

namespace codesign {

Problem loaded(const std::string& urdf, const std::string& study) {
  return load_problem({"model.urdf", urdf}, {}, {"study.yaml", study});
}

std::string body(const std::string& name, double mass, const std::string& centre) {
  const std::string number = std::to_string(mass);
  return "<link name=\"" + name + "\"><inertial><origin xyz=\"" + centre + "\"/><mass value=\"" +
         number +
         "\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>" +
         "</inertial></link>";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& origin, const std::string& axis,
                  const std::string& more) {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/><origin xyz=\"" + origin + "\"/><axis xyz=\"" + axis +
         "\"/>" + more + "</joint>";
}

std::string planar_slider_crank(const std::string& slider_friction) {
  return R"(<robot name="slider_crank" xmlns:codesign="urn:mechanism_codesign"><link name="base"/>)" +
         body("crank", 0.5) + body("slider", 1.0) +
         joint("crank_joint", "continuous", "base", "crank", "0 0 0", "0 -1 0") +
         joint("slider_joint", "prismatic", "base", "slider", "0 0 0", "1 0 0",
               slider_friction + R"(<limit lower="-1" upper="1" effort="100" velocity="10"/>)") +
         R"(<loop name="rod" type="codesign:distance"><predecessor link="crank"><origin xyz="0.1 0 0"/>
            </predecessor><successor link="slider"/><codesign:length value="0.3"/></loop></robot>)";
}

std::string balanced_arm(double mass, double stiffness) {
  return R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign"><link name="base"/>)" +
         body("bar", mass, "0 0 0.5") +
         joint("hinge", "continuous", "base", "bar", "0 0 0", "0 1 0") +
         R"(<codesign:spring_damper name="spring" stiffness=")" + std::to_string(stiffness) +
         R"("><predecessor link="base"><origin xyz="0 0 0.4"/></predecessor><successor link="bar">
            <origin xyz="0 0 0.25"/></successor></codesign:spring_damper></robot>)";
}

}  // namespace codesign
