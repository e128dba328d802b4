// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "description/robot.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/vocabulary.h"
#include "reading/xml/xml_element.h"

namespace codesign {

/// The names that readers of joints, loops and springs refer to, and where they put warnings.
struct ReadContext {
  std::vector<std::string> links;  ///< names, in the order of RobotDescription::links
  ParameterTable table;
  Warnings* warnings = nullptr;                         ///< never null while a robot is read
  const Laws* laws = &standard_laws();                  ///< never null
  std::unordered_map<std::string, int> link_indices{};  ///< of `links`; empty: they are searched

  /// Index of the link that `attribute` names. @throws InputError naming the link with the nearest
  /// name.
  int link(const XmlElement& element, const std::string& attribute) const;
  /// The links of `<predecessor link>` and `<successor link>`. @throws InputError if they are the
  /// same.
  std::pair<int, int> ends(const XmlElement& element) const;
};

/// Reads one `<codesign:friction>`. @param axis of the joint; the transverse axis must not be
/// parallel to it. @throws InputError
FrictionDescription read_friction(const XmlElement& element, const QuantityVector& axis,
                                  const ReadContext& context);

/// Reads the attribute `transverse_axis`. @throws InputError if it is parallel to the axis.
std::array<double, 3> read_transverse_axis(const XmlElement& element, const QuantityVector& axis);

/// Reads one `<codesign:actuator>` of a joint of this law. @throws InputError
ActuatorDescription read_actuator(const XmlElement& element, const JointLaw& law,
                                  const ReadContext& context);

// Two overloads for each kind of elements between links, for_each_link_element_kind(): one reads an
// element, and throws InputError, the other adds the rules of its annotations. @param path of the
// elements

/// `<codesign:spring_damper>`; theory (13b).
void read_link_element(const XmlElement& element, const ReadContext& context,
                       SpringDamperDescription* spring);
void add_rules_of(const std::vector<SpringDamperDescription>& kind, const std::string& path,
                  std::vector<ElementRule>* rules);
/// `<codesign:contact>`: shapes, normal force and friction; theory (13k) to (13m). Shapes that
/// cannot touch each other are an error, which names those that can.
void read_link_element(const XmlElement& element, const ReadContext& context,
                       ContactDescription* contact);
void add_rules_of(const std::vector<ContactDescription>& kind, const std::string& path,
                  std::vector<ElementRule>* rules);

/// Reads what `<codesign:contact>` and `<codesign:clearance>` have in common: law, stiffness, loss
/// and friction. @param contact with its two ends. @throws InputError
void read_contact_force(const XmlElement& element, const ReadContext& context,
                        ContactDescription* contact);
/// Reads the material of one side of a contact. @throws InputError
void read_material(const XmlElement& element, const ReadContext& context, ContactEnd* end);

/// Replaces the constraint of each joint and loop with a `<codesign:clearance>` by the contact of
/// journal and bearing, theory (13n): adds joints of the tree, NAME_x and so on with
/// JointDescription::is_play, by which its parent's side moves freely, and the contacts
/// NAME_clearance. @throws InputError
void read_clearances(const XmlElement& robot, const ReadContext& context,
                     RobotDescription* description);

/// Reads a `<joint>` of the tree. @throws InputError
JointDescription read_joint(const XmlElement& element, const ReadContext& context);

/// Reads a `<loop>`, of URDF+ or with one of our types. @throws InputError
JointDescription read_loop(const XmlElement& element, const ReadContext& context);

/// Sets the gear ratio of every `<codesign:actuator>` without `gear_ratio` to the mechanical
/// reduction in the ROS `<transmission>` of its joint. A reduction that cannot be used is ignored
/// with a warning: `transmission_not_read`, `transmission_contradicts` or
/// `transmission_not_simple`. Transmissions of joints without an actuator are not examined.
/// @param element the `<robot>`. @param robot its joints must have been read.
void read_transmissions(const XmlElement& element, RobotDescription* robot);

/// The ratio of two links that roll on each other: the `<ratio>` given, else the ratio of the
/// distances from the points of contact, the origins of predecessor and successor, to the axes of
/// the joints above the links; 1 without such points.
double rolling_ratio(const XmlElement& element, const CouplingDescription& coupling,
                     const RobotDescription& robot, const ParameterTable& table);

/// Reads the `<constraint>` elements of mit-biomimetics/URDF-Parser. `type="position"` and
/// `type="spherical_joint"`, where two points coincide, become a spherical loop; `type="rolling"`
/// becomes a coupling with the ratio given or the ratio of the points' distances from the joint
/// axes. A constraint that cannot be read is ignored with a warning (`loop_ignored`).
void read_constraints(const XmlElement& robot, const ReadContext& context,
                      RobotDescription* description);

/// Whether a loop of the description connects two links, named in either order.
bool has_loop_between(const RobotDescription& robot, const std::string& a, const std::string& b);

/// Warns (`loop_ignored`) of elements that close loops or couple joints in other tools and are not
/// read here: `<loop_joint>`,
/// `<gazebo><joint>`, mimic and DetachableJoint plugins, `drake:*_constraint`, `drake:joint`,
/// `drake:linear_bushing_rpy`, MuJoCo's
/// `<equality>`. Each warning shows the element to write instead, with `...` for values that the
/// file does not give. There is no warning where the description has a loop between the two links,
/// or a coupling or `<mimic>` of the joint, already.
/// @param description must already contain the links and joints.
void warn_of_foreign_loops(const XmlElement& robot, const RobotDescription& description,
                           Warnings* warnings);

}  // namespace codesign
