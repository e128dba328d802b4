// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rounded_linkages.h"

#include <string>

namespace codesign {

namespace rounded {

std::string link(const std::string& name, double length) {
  return "<link name='" + name + "'><inertial><origin xyz='" + to_decimal(0.5 * length) +
         " 0 0.02'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.03' iyz='0' "
         "izz='0.03'/></inertial></link>";
}

std::string hinge(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& origin, bool with_friction) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='0 0 1'/>" +
         (with_friction ? "<codesign:friction mu_static='0.24' codesign:mu_static='${1.2*mu}' "
                          "mu_dynamic='0.2' codesign:mu_dynamic='${mu}' "
                          "joint_length='0.05' pin_radius='0.02'/>"
                        : "") +
         "</joint>";
}

std::string closure(const std::string& name, const std::string& predecessor, const std::string& at,
                    const std::string& successor, const std::string& there) {
  return "<loop name='" + name + "' type='revolute'><predecessor link='" + predecessor +
         "'><origin " + at + "/></predecessor><successor link='" + successor + "'><origin " +
         there + "/></successor><axis xyz='0 0 1'/></loop>";
}

std::string robot(const std::string& content) {
  return "<robot name='rounded' xmlns:codesign='urn:test'><codesign:parameter name='mu' "
         "value='0.2' lower='0' upper='0.5'/><link "
         "name='ground'/><link name='frame'/><joint name='tilt' type='fixed'><parent "
         "link='ground'/><child link='frame'/><origin rpy='0.3 "
         "0.4 0.2'/></joint>" +
         content + "</robot>";
}

std::string four_bar(const std::string& suffix, const std::string& height,
                     const std::string& missed_height, const std::string& rounding) {
  return link("crank" + suffix, 0.1) + link("coupler" + suffix, 0.35) +
         link("rocker" + suffix, 0.25) +
         hinge("j1" + suffix, "frame", "crank" + suffix, "xyz='0 0 " + height + "'", true) +
         hinge("j2" + suffix, "crank" + suffix, "coupler" + suffix, "xyz='0.1 0 0'") +
         hinge("j3" + suffix, "frame", "rocker" + suffix, "xyz='0.3 0 " + missed_height + "'") +
         closure("closure" + suffix, "coupler" + suffix, "xyz='0.35 0 0' rpy='" + rounding + "'",
                 "rocker" + suffix, "xyz='0.25 0 0'");
}

std::string two_four_bars() {
  return robot(four_bar("_a", "0", "0.00003", "0.00001 -0.00002 0") +
               four_bar("_b", "0.5", "0.49998", "-0.00002 0.00001 0"));
}

const char* two_four_bars_start() {
  return "{j1_a: {position: 0.5, velocity: 1.0}, j3_a: {guess: 1.5}, j1_b: {position: 0.9, "
         "velocity: 2.0}, j3_b: {guess: 1.5}}";
}

std::string three_cranks() {
  std::string content;
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k);
    content += link("crank" + number, 0.1) +
               hinge("j" + number, "frame", "crank" + number,
                     "xyz='" + to_decimal(0.2 * k) + " 0 " + to_decimal(2e-5 * k) + "'", k == 0);
  }
  content += link("bar", 0.4) + hinge("pin", "crank0", "bar", "xyz='0.1 0 0'");
  for (int k = 1; k < 3; ++k)
    content += closure("close" + std::to_string(k), "bar",
                       "xyz='" + to_decimal(0.2 * k) + " 0 0' rpy='0.00001 -0.00002 0'",
                       "crank" + std::to_string(k), "xyz='0.1 0 0'");
  return robot(content);
}

const char* three_cranks_start() {
  return "{j0: {position: 0.6, velocity: 1.0}, j1: {guess: 0.6}, j2: {guess: 0.6}, pin: {guess: "
         "-0.6}}";
}

std::string bennett() {
  const std::string a = "xyz='0.3 0 0' rpy='0.5 0 0'";
  return robot(link("l1", 0.3) + link("l2", 0.490166) + link("l3", 0.3) +
               hinge("t1", "frame", "l1", "xyz='0 0 0'", true) + hinge("t2", "l1", "l2", a) +
               hinge("t3", "l2", "l3", "xyz='0.490166 0 0' rpy='0.9 0 0'") +
               closure("t4", "l3", a, "frame", "xyz='-0.490166 0 0' rpy='-0.9 0 0'"));
}

const char* bennett_start() {
  return "{t1: {position: 1.2, velocity: 1.0}, t2: {guess: 2.7257}, t3: {guess: -1.2}}";
}

std::string parallel_arms() {
  std::string content = link("c1", 0.2) + link("f1", 0.3) + link("platform", 0.1) +
                        hinge("m1", "frame", "c1", "xyz='0 0 0'", true) +
                        hinge("e1", "c1", "f1", "xyz='0.2 0 0'") +
                        hinge("w1", "f1", "platform", "xyz='0.3 0 0'");
  content += link("c2", 0.2) + link("f2", 0.3) + hinge("m2", "frame", "c2", "xyz='0.4 0 0.00002'") +
             hinge("e2", "c2", "f2", "xyz='0.2 0 0' rpy='0.00001 0.00002 0'") +
             closure("k2", "f2", "xyz='0.3 0 0'", "platform", "xyz='0.1 0 0'");
  content += link("triangle", 0.08) + link("c3", 0.2) + link("f3", 0.3) +
             hinge("m3", "frame", "c3", "xyz='0 0.08 0'") +
             hinge("tr", "c1", "triangle", "xyz='0.2 0 0'") +
             closure("k3", "c3", "xyz='0.2 0 0' rpy='0 0.00001 0'", "triangle", "xyz='0 0.08 0'") +
             hinge("e3", "triangle", "f3", "xyz='0 0.08 0'") +
             closure("k4", "f3", "xyz='0.3 0 0' rpy='0.00002 0 0'", "platform", "xyz='0 0.08 0'");
  return robot(content);
}

const char* parallel_arms_start() {
  return "{m1: {position: 1.9, velocity: 1.0}, e1: {guess: -1.2}, w1: {guess: -0.7}, m2: "
         "{position: 1.2, velocity: -0.5}, e2: {guess: "
         "1.0}, "
         "m3: {guess: 1.9}, tr: {guess: -1.9}, e3: {guess: 0.7}}";
}

std::string study(const std::string& start, const std::string& signal, double duration,
                  double tolerance, const std::string& integrator) {
  return "duration: " + to_decimal(duration) +
         "\ngravity: [0, -9.81, 0]\nparameters: {mu: {}}\ninitial_state: " + start +
         "\nsolver: {integrator: " + integrator + ", relative_tolerance: " + to_decimal(tolerance) +
         ", absolute_tolerance: " + to_decimal(tolerance) +
         "}\nobjective: {integral: [{signal: " + signal + "}]}\n";
}

}  // namespace rounded
}  // namespace codesign
