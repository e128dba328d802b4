// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/vocabulary.h"

#include <algorithm>
#include <set>

#include "description/robot.h"
#include "reading/urdf/annotation_rules.h"
#include "reading/urdf/joint_reader.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;
using Rule = AnnotationRule;

void add_shapes(const std::string& path, std::vector<ElementRule>* rules) {
  rules->push_back(Rule(path + "/origin").twins({"xyz", "rpy"}));
  rules->push_back(Rule(path + "/geometry/box").twins({"size"}));
  rules->push_back(Rule(path + "/geometry/cylinder").twins({"radius", "length"}));
  rules->push_back(Rule(path + "/geometry/sphere").twins({"radius"}));
}

Names clearance_numbers() {
  Names names{"radial", "axial", "radius", "length", "width", "youngs_modulus", "poisson_ratio"};
  for (const std::string& name : contact_numbers()) names.push_back(name);
  return names;
}

Names friction_attributes() {
  Names names;
  visit_friction_numbers(
      [&names](const FrictionNumberRule& rule) { names.emplace_back(rule.attribute); });
  return names;
}

Names actuator_attributes() {
  Names names{"gear_ratio",  "rotor_inertia", "efficiency", "backdrive_efficiency",
              "coulomb",     "viscous",       "stiffness",  "damping",
              "backlash",    "resistance",    "inductance", "torque_constant",
              "bus_voltage", "armature"};
  visit_friction_numbers([&names](const FrictionNumberRule& rule) {
    if (rule.of_gears) names.emplace_back(rule.attribute);
  });
  return names;
}

void add_joint_parts(const std::string& path, bool strict, std::vector<ElementRule>* rules) {
  rules->push_back(Rule(path + "/axis").strict(strict).twins({"xyz"}));
  rules->push_back(
      Rule(path + "/dynamics").strict(strict).twins({"damping", "friction", "armature"}));
  rules->push_back(Rule(path + "/codesign:friction")
                       .strict()
                       .plain({"model", "transverse_axis"})
                       .twins(friction_attributes()));
  rules->push_back(Rule(path + "/codesign:torsion_spring")
                       .strict()
                       .twins({"stiffness", "damping", "free_position"}));
  rules->push_back(
      Rule(path + "/codesign:actuator").strict().plain({"model"}).twins(actuator_attributes()));
  rules->push_back(Rule(path + "/codesign:clearance")
                       .strict()
                       .plain({"model", "transverse_axis"})
                       .twins(clearance_numbers())
                       .children({"codesign:friction"}));
  add_contact_friction(path + "/codesign:clearance", rules);
}

void add_link_rules(std::vector<ElementRule>* rules) {
  rules->push_back(Rule("robot/link/inertial").own({"density", "from", "inertia"}));
  rules->push_back(Rule("robot/link/inertial/origin").twins({"xyz", "rpy"}));
  rules->push_back(Rule("robot/link/inertial/mass").twins({"value"}));
  rules->push_back(
      Rule("robot/link/inertial/inertia").twins({"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}));
  add_shapes("robot/link/visual", rules);
  add_shapes("robot/link/collision", rules);
}

std::vector<ElementRule> make_rules() {
  std::vector<ElementRule> rules;
  const RobotDescription robot;
  Names of_robot{"codesign:parameter", "codesign:set"};
  for (const std::string& tag : link_element_tags()) of_robot.push_back(tag);
  rules.push_back(Rule("robot").children(of_robot));
  rules.push_back(
      Rule("robot/codesign:parameter").strict().plain({"name", "value", "lower", "upper", "unit"}));
  rules.push_back(Rule("robot/codesign:set").strict().plain({"name", "value", "lower", "upper"}));
  for_each_link_element_kind(robot, [&rules](const LinkElementKind& kind, const auto& elements) {
    add_rules_of(elements, std::string("robot/") + kind.tag, &rules);
  });

  add_link_rules(&rules);

  rules.push_back(Rule("robot/joint")
                      .own({"type"})
                      .children({"codesign:friction", "codesign:torsion_spring",
                                 "codesign:actuator", "codesign:clearance"}));
  rules.push_back(Rule("robot/joint/origin").twins({"xyz", "rpy"}));
  rules.push_back(Rule("robot/joint/limit").twins({"lower", "upper", "effort", "velocity"}));
  rules.push_back(Rule("robot/joint/mimic").twins({"multiplier", "offset"}));
  add_joint_parts("robot/joint", false, &rules);

  rules.push_back(
      Rule("robot/loop")
          .strict()
          .plain({"name", "type"})
          .own({"out_of_plane"})
          .children({"predecessor", "successor", "axis", "dynamics", "codesign:second_axis",
                     "codesign:length", "codesign:friction", "codesign:torsion_spring",
                     "codesign:actuator", "codesign:clearance"}));
  add_ends("robot/loop", &rules);
  add_joint_parts("robot/loop", true, &rules);
  rules.push_back(Rule("robot/loop/codesign:second_axis").strict().twins({"xyz"}));
  rules.push_back(Rule("robot/loop/codesign:length").strict().twins({"value"}));

  rules.push_back(Rule("robot/coupling")
                      .strict()
                      .plain({"name", "type"})
                      .children({"predecessor", "successor", "ratio"}));
  add_ends("robot/coupling", &rules);
  rules.push_back(Rule("robot/coupling/ratio").strict().twins({"value"}));
  return rules;
}

const std::vector<ElementRule>& rules() {
  static const std::vector<ElementRule> kRules = make_rules();
  return kRules;
}

}  // namespace

void add_ends(const std::string& path, std::vector<ElementRule>* rules) {
  for (const char* end : {"/predecessor", "/successor"}) {
    rules->push_back(Rule(path + end).strict().plain({"link"}).children({"origin"}));
    rules->push_back(Rule(path + end + "/origin").strict().twins({"xyz", "rpy"}));
  }
}

void add_contact_friction(const std::string& path, std::vector<ElementRule>* rules) {
  rules->push_back(
      Rule(path + "/codesign:friction")
          .strict()
          .plain({"model"})
          .twins({"mu_static", "mu_dynamic", "transition_velocity", "stribeck_velocity"}));
}

std::size_t words_of(const std::string& attribute) {
  return attribute == "xyz" || attribute == "rpy" || attribute == "size" ? 3 : 1;
}

const ElementRule* find_rule(const std::string& path) {
  static const auto kByPath = by_path(rules());
  const auto found = kByPath.find(path);
  return found != kByPath.end() ? found->second : nullptr;
}

std::vector<std::string> annotation_elements() {
  std::set<std::string> names;
  for (const ElementRule& rule : rules()) {
    const std::string tag = rule.path.substr(rule.path.rfind('/') + 1);
    if (tag.find(':') != std::string::npos) names.insert(tag);
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> places_of(const std::string& annotation) {
  std::vector<std::string> places;
  for (const ElementRule& rule : rules()) {
    const std::string place = "<" + rule.path.substr(rule.path.rfind('/') + 1) + ">";
    if (std::find(rule.children.begin(), rule.children.end(), annotation) != rule.children.end() &&
        std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(place);
  }
  return places;
}

}  // namespace codesign
