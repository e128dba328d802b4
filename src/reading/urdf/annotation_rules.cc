// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/vocabulary.h"

#include <algorithm>
#include <set>

#include "description/robot.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

void add_shapes(const std::string& path, std::vector<ElementRule>* rules) {
  rules->push_back({path + "/origin", false, {}, {"xyz", "rpy"}, {}, {}});
  rules->push_back({path + "/geometry/box", false, {}, {"size"}, {}, {}});
  rules->push_back({path + "/geometry/cylinder", false, {}, {"radius", "length"}, {}, {}});
  rules->push_back({path + "/geometry/sphere", false, {}, {"radius"}, {}, {}});
}

/// `<predecessor link>` and `<successor link>` with an `<origin>`.
void add_ends(const std::string& path, std::vector<ElementRule>* rules) {
  for (const char* end : {"/predecessor", "/successor"}) {
    rules->push_back({path + end, true, {"link"}, {}, {}, {"origin"}});
    rules->push_back({path + end + "/origin", true, {}, {"xyz", "rpy"}, {}, {}});
  }
}

Names friction_attributes() {
  Names names;
  visit_friction_numbers(
      [&names](const FrictionNumberRule& rule) { names.emplace_back(rule.attribute); });
  return names;
}

Names actuator_attributes() {
  Names names{"gear_ratio", "rotor_inertia", "efficiency", "backdrive_efficiency",
              "coulomb",    "viscous",       "stiffness",  "damping",
              "backlash"};
  visit_friction_numbers([&names](const FrictionNumberRule& rule) {
    if (rule.of_gears) names.emplace_back(rule.attribute);
  });
  return names;
}

void add_joint_parts(const std::string& path, bool strict, std::vector<ElementRule>* rules) {
  rules->push_back({path + "/axis", strict, {}, {"xyz"}, {}, {}});
  rules->push_back({path + "/dynamics", strict, {}, {"damping", "friction"}, {}, {}});
  rules->push_back({path + "/codesign:friction",
                    true,
                    {"model", "transverse_axis"},
                    friction_attributes(),
                    {},
                    {}});
  rules->push_back({path + "/codesign:torsion_spring",
                    true,
                    {},
                    {"stiffness", "damping", "free_position"},
                    {},
                    {}});
  rules->push_back({path + "/codesign:actuator", true, {"model"}, actuator_attributes(), {}, {}});
}

void add_link_rules(std::vector<ElementRule>* rules) {
  rules->push_back({"robot/link/inertial", false, {}, {}, {"density", "from", "inertia"}, {}});
  rules->push_back({"robot/link/inertial/origin", false, {}, {"xyz", "rpy"}, {}, {}});
  rules->push_back({"robot/link/inertial/mass", false, {}, {"value"}, {}, {}});
  rules->push_back({"robot/link/inertial/inertia",
                    false,
                    {},
                    {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"},
                    {},
                    {}});
  add_shapes("robot/link/visual", rules);
  add_shapes("robot/link/collision", rules);
}

std::vector<ElementRule> make_rules() {
  std::vector<ElementRule> rules;
  rules.push_back({"robot",
                   false,
                   {},
                   {},
                   {},
                   {"codesign:parameter", "codesign:set", "codesign:spring_damper"}});
  rules.push_back(
      {"robot/codesign:parameter", true, {"name", "value", "lower", "upper", "unit"}, {}, {}, {}});
  rules.push_back({"robot/codesign:set", true, {"name", "value", "lower", "upper"}, {}, {}, {}});
  rules.push_back({"robot/codesign:spring_damper",
                   true,
                   {"name"},
                   {"stiffness", "damping", "free_length"},
                   {},
                   {"predecessor", "successor"}});
  add_ends("robot/codesign:spring_damper", &rules);

  add_link_rules(&rules);

  rules.push_back({"robot/joint",
                   false,
                   {},
                   {},
                   {"type"},
                   {"codesign:friction", "codesign:torsion_spring", "codesign:actuator"}});
  rules.push_back({"robot/joint/origin", false, {}, {"xyz", "rpy"}, {}, {}});
  rules.push_back(
      {"robot/joint/limit", false, {}, {"lower", "upper", "effort", "velocity"}, {}, {}});
  rules.push_back({"robot/joint/mimic", false, {}, {"multiplier", "offset"}, {}, {}});
  add_joint_parts("robot/joint", false, &rules);

  rules.push_back(
      {"robot/loop",
       true,
       {"name", "type"},
       {},
       {"out_of_plane"},
       {"predecessor", "successor", "axis", "dynamics", "codesign:second_axis", "codesign:length",
        "codesign:friction", "codesign:torsion_spring", "codesign:actuator"}});
  add_ends("robot/loop", &rules);
  add_joint_parts("robot/loop", true, &rules);
  rules.push_back({"robot/loop/codesign:second_axis", true, {}, {"xyz"}, {}, {}});
  rules.push_back({"robot/loop/codesign:length", true, {}, {"value"}, {}, {}});

  rules.push_back(
      {"robot/coupling", true, {"name", "type"}, {}, {}, {"predecessor", "successor", "ratio"}});
  add_ends("robot/coupling", &rules);
  rules.push_back({"robot/coupling/ratio", true, {}, {"value"}, {}, {}});
  return rules;
}

const std::vector<ElementRule>& rules() {
  static const std::vector<ElementRule> kRules = make_rules();
  return kRules;
}

}  // namespace

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
  for (const ElementRule& rule : rules())
    if (std::find(rule.children.begin(), rule.children.end(), annotation) != rule.children.end())
      places.push_back("<" + rule.path.substr(rule.path.rfind('/') + 1) + ">");
  return places;
}

}  // namespace codesign
