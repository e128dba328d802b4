// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/starting_overlay.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "description/clearance.h"
#include "math/arrays.h"
#include "mechanism/mass_properties.h"
#include "mechanism/rigid_groups.h"
#include "reading/urdf/drive_lines.h"
#include "reading/urdf/inertial_reader.h"
#include "reading/urdf/overlay_lines.h"
#include "reading/urdf/urdf_checks.h"
#include "reading/urdf/urdf_reader.h"
#include "reading/xml/xml_element.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kDensity = 1000.0;  // of plastics [kg/m^3]

/// A name that no element of the list has.
std::string free_name(const std::string& wanted, const std::vector<std::string>& taken) {
  std::string name = wanted;
  for (int k = 2; contains(taken, name); ++k) name = wanted + "_" + std::to_string(k);
  return name;
}

/// The number of a plain attribute that readers of URDF ignore.
double plain_number_of(const std::optional<XmlElement>& element, const char* attribute) {
  const std::optional<std::string> text = element ? element->find(attribute) : std::nullopt;
  const double number = text ? parse_number(*text).value_or(0.0) : 0.0;
  return std::isfinite(number) ? number : 0.0;
}

class Writer {
 public:
  Writer(const SourceText& urdf, std::vector<SourceText> overlays)
      : urdf_(urdf),
        overlays_(std::move(overlays)),
        document_(load_annotated_urdf(urdf, overlays_)),
        robot_(read_robot(document_)),
        table_(robot_.parameters),
        groups_(robot_) {
    weigh();
    find_gear_ratios();
  }

  std::string write() {
    write_base();
    write_masses();
    write_joints();
    const std::string name = robot_.name.empty() ? "overlay" : robot_.name + "_overlay";
    return "<?xml version=\"1.0\"?>\n" + as_overlay(name, heading() + lines_.text()).text;
  }

 private:
  std::string heading() const {
    OverlayLines lines;
    lines.say(
        "What the file of " + robot_.name +
        " does not say, an overlay for it. A line in a comment needs numbers of yours: write "
        "them in place of the usual ones, and take the marks of the comment away. Delete what "
        "the machine does not have. doc/annotations.md explains each element.");
    return lines.text().substr(1);
  }

  int group_of(int link) const { return groups_.link_base[to_index(link)]; }
  bool is_ground(int link) const { return group_of(link) == group_of(robot_.root); }
  double mass_of(int link) const {
    const auto found = masses_.find(group_of(link));
    return found == masses_.end() ? 0.0 : found->second;
  }
  bool has_inertia(int link) const { return masses_.count(group_of(link)) != 0; }

  void weigh() {
    for (std::size_t k = 0; k < robot_.links.size(); ++k) {
      const std::optional<InertialDescription>& inertial = robot_.links[k].inertial;
      if (inertial)
        masses_[group_of(static_cast<int>(k))] += mass_properties(*inertial, table_.values).mass;
    }
    for (std::size_t k = 0; k < robot_.links.size(); ++k)
      something_moves_ =
          something_moves_ || (!is_ground(static_cast<int>(k)) && has_inertia(static_cast<int>(k)));
  }

  bool takes_actuator(const JointDescription& joint) const {
    return !joint.is_loop && joint.has_one_coordinate() && !joint.actuator && !joint.mimic &&
           !plays(joint);
  }

  /// Whether it belongs to a clearance: the joint, which has neither rotor nor friction of its own,
  /// or one of those that let it play.
  bool plays(const JointDescription& joint) const {
    return joint.is_play || has_clearance(robot_, joint);
  }

  /// The reductions of `<transmission>`, which are read for joints with an actuator.
  void find_gear_ratios() {
    std::string body;
    for (const JointDescription& joint : robot_.joints)
      if (takes_actuator(joint))
        body += element_named("joint", joint.name, "<codesign:actuator rotor_inertia=\"1\"/>");
    std::vector<SourceText> overlays = overlays_;
    overlays.push_back(as_overlay("gear ratios", body));
    for (const JointDescription& joint : read_urdf(urdf_, overlays).joints)
      if (joint.actuator) ratios_[joint.name] = joint.actuator->gear_ratio.nominal();
  }

  DriveFacts facts_of(const JointDescription& joint) const {
    const auto found = ratios_.find(joint.name);
    // 1 is what files have that do not know better.
    const bool is_known = found != ratios_.end() && std::abs(found->second) != 1.0;
    return {joint, is_known ? found->second : 0.0, obstacle(joint)};
  }

  void write_base() {
    const double mass = mass_of(robot_.root);
    if (!(mass > 0.0)) return;
    const std::string& root = robot_.links[to_index(robot_.root)].name;
    std::vector<std::string> links, joints;
    for (const LinkDescription& link : robot_.links) links.push_back(link.name);
    for (const JointDescription& joint : robot_.joints) joints.push_back(joint.name);
    const std::string world = free_name("world", links);
    const std::string joint = free_name("floating_base", joints);
    const std::string lines = element_named("link", world, "") +
                              "<joint name=" + attribute_text(joint) +
                              " type=\"floating\"><parent link=" + attribute_text(world) +
                              "/><child link=" + attribute_text(root) + "/></joint>";
    lines_.say("Base: the root link " + root + " is the ground, and the " + readable(mass, 4) +
               " kg that are fixed to it have no effect. " +
               (something_moves_ ? "If it flies, walks, swims or rolls, a new root with a floating "
                                   "joint makes it free"
                                 : "Nothing else has a mass, so it moves by a floating joint from "
                                   "a new root") +
               "; the study gives the start: initial_state: {" + joint +
               ": {translation: [0, 0, 1], rotation: [0, 0, 0]}}.");
    if (something_moves_)
      lines_.to_fill_in(lines);
    else
      lines_.add(lines);
  }

  /// The first link of each massless body that has shapes, or the first at all where nothing has a
  /// mass.
  void write_masses() {
    const XmlElement robot(document_.robot(), &document_);
    const std::vector<XmlElement> links = robot.children("link");
    for (std::size_t k = 0; k < links.size(); ++k) {
      const int link = static_cast<int>(k);
      const bool has_shapes = links[k].child("visual") || links[k].child("collision");
      if (is_ground(link) || has_inertia(link) || !has_shapes) continue;
      asked_.emplace(group_of(link), link);
    }
    if (asked_.empty() && !something_moves_ && !has_inertia(robot_.root))
      for (std::size_t k = 0; k < links.size(); ++k)
        if (!is_ground(static_cast<int>(k)))
          asked_.emplace(group_of(static_cast<int>(k)), static_cast<int>(k));
    for (const auto& [group, link] : asked_) write_mass(links[to_index(link)]);
  }

  void write_mass(const XmlElement& link) {
    const std::string name = link.text("name");
    const std::string density = to_decimal(kDensity);
    for (const char* from : {"visual", "collision"}) {
      const std::string inertial = inertial_of_shapes(link, from, kDensity, table_);
      if (inertial.empty()) continue;
      lines_.say("Mass of " + name + ", which has none: of its shapes (" + from +
                 ") at a density. Usual: " + density +
                 " kg/m^3 of plastics, aluminium 2700, steel 7850; mass and inertia are "
                 "proportional to it, and codesign names the new ones.");
      return lines_.to_fill_in(element_named("link", name, inertial));
    }
    lines_.say("Mass of " + name + ", which has none" + meshes_of(link) +
               ": kg, centre of mass [m] and inertia about it [kg m^2] in the link's axes, from a "
               "data sheet or CAD. Programs for meshes print volume, centre and inertia at density "
               "1: times 1000 kg/m^3 of plastics, 2700 of aluminium, 7850 of steel. The numbers "
               "here are those of a ball of 1 kg and 0.1 m.");
    lines_.to_fill_in(
        element_named("link", name,
                      "<inertial><origin xyz=\"0 0 0\" rpy=\"0 0 0\"/><mass value=\"1\"/>"
                      "<inertia ixx=\"0.004\" ixy=\"0\" ixz=\"0\" iyy=\"0.004\" iyz=\"0\" "
                      "izz=\"0.004\"/></inertial>"));
  }

  /// " but the mesh a.stl", of the visuals, else of the collisions.
  static std::string meshes_of(const XmlElement& link) {
    for (const char* tag : {"visual", "collision"})
      for (const XmlElement& shape : link.children(tag)) {
        const std::optional<XmlElement> geometry = shape.child("geometry");
        const std::optional<XmlElement> mesh =
            geometry ? geometry->child("mesh") : std::optional<XmlElement>();
        if (mesh && mesh->has("filename")) return " but the mesh " + *mesh->find("filename");
      }
    return "";
  }

  void write_joints() {
    const XmlElement robot(document_.robot(), &document_);
    const std::vector<XmlElement> joints = robot.children("joint");
    for (const JointDescription& joint : robot_.joints) {
      const auto element = std::find_if(joints.begin(), joints.end(), [&](const XmlElement& one) {
        return one.find("name") == joint.name;
      });
      if (joint.is_loop || joint.mimic || !joint.has_one_coordinate() || plays(joint)) continue;
      if (element != joints.end()) write_joint(joint, *element);
    }
  }

  void write_joint(const JointDescription& joint, const XmlElement& element) {
    const double armature = plain_number_of(element.child("dynamics"), "armature");
    const bool has_friction =
        joint.friction || !joint.damping.is_zero() || !joint.dry_friction.is_zero();
    const bool may_have_mass = !stays_massless(joint.child) && !stays_massless(joint.parent);
    if (takes_actuator(joint) && armature > 0.0)
      write_armature(facts_of(joint), armature, &lines_);
    else if (takes_actuator(joint) && may_have_mass)
      write_gear(facts_of(joint), &lines_);
    if (!has_friction) write_friction(joint, &lines_);
  }

  /// Why the joint cannot have a rotor as long as masses are missing; empty: it can.
  std::string obstacle(const JointDescription& joint) const {
    if (!has_inertia(joint.child)) return "once what it moves has a mass";
    return is_ground(joint.parent) || has_inertia(joint.parent)
               ? ""
               : "once the link above it, which carries the motor, has a mass";
  }

  /// Links between the joints of a compound joint, which have no mass and are not asked for one.
  bool stays_massless(int link) const {
    return !is_ground(link) && !has_inertia(link) && asked_.count(group_of(link)) == 0;
  }

  const SourceText& urdf_;
  const std::vector<SourceText> overlays_;
  const XmlDocument document_;
  const RobotDescription robot_;
  const ParameterTable table_;
  const RigidGroups groups_;
  std::map<int, double> masses_;  ///< of bodies with inertia, by the base link of the group
  std::map<int, int> asked_;      ///< links whose mass is a line, by the base link of the group
  std::map<std::string, double> ratios_;  ///< of joints that could have an actuator, or have one
  bool something_moves_ = false;          ///< a body with inertia beside the ground
  OverlayLines lines_;
};

}  // namespace

std::string starting_overlay(const SourceText& urdf, const std::vector<SourceText>& overlays) {
  return Writer(urdf, overlays).write();
}

}  // namespace codesign
