// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "description/clearance.h"
#include "math/arrays.h"
#include "mechanism/pose.h"
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/quantity_reader.h"

namespace codesign {
namespace {

QuantityVector constant(const Vector3<double>& x) { return {x[0], x[1], x[2]}; }

/// Reads one `<codesign:clearance>` that is not zero. The joint keeps its type and coordinate; its
/// parent becomes a link without mass, which joints of the tree let move against the former one.
class ClearanceReader {
 public:
  ClearanceReader(const XmlElement& element, const ReadContext& context, RobotDescription* robot)
      : element_(element), context_(context), robot_(*robot) {}

  void read(const Quantity& radial, JointDescription* joint) {
    radial_ = radial;
    axes_.axis = joint->axis;
    take_friction(joint);
    refuse_rotor(*joint);
    if (joint->is_slide())
      guide(joint);
    else
      bearing(joint);
  }

  /// What it adds before the loops.
  std::vector<JointDescription> joints;

 private:
  bool is_ball(const JointDescription& joint) const { return joint.freedoms().turns == 3; }

  void take_friction(JointDescription* joint) const {
    if (!joint->friction) return;
    if (!element_.child("codesign:friction"))
      throw InputError({joint->friction->where, joint->element() + " <codesign:friction>",
                        "a joint with clearance has the friction of its contact", "",
                        "<codesign:friction> in <codesign:clearance>; that of the joint is for "
                        "radial=\"0\""});
    joint->friction.reset();
  }

  /// The link without mass above the joint cannot carry a rotor.
  static void refuse_rotor(const JointDescription& joint) {
    if (!joint.actuator || joint.actuator->rotor_inertia.is_zero()) return;
    throw InputError({joint.actuator->where, joint.element() + " <codesign:actuator>",
                      "a joint with clearance has no link that carries a rotor", "",
                      "armature in place of rotor_inertia; or the rotor as a link of its own"});
  }

  /// Journal and bearing, or ball and socket.
  void bearing(JointDescription* joint) {
    refuse("length", "a slide");
    refuse("width", "a slide");
    refuse("transverse_axis", "a slide");
    const bool is_ball = this->is_ball(*joint), is_axial = element_.has("axial");
    if (is_ball) refuse("axial", "a hinge");
    const Quantity radius = read_quantity(element_, "radius", Range::kPositive, context_.table);
    ContactDescription contact = contact_of(*joint, clearance_contact(joint->name), radial_);
    contact.surface.shape = is_axial ? ShapeKind::kBore : ShapeKind::kSocket;
    contact.surface.radius = contact.points.radius = radius;
    if (is_axial) contact.surface.axes = axes_;
    add(std::move(contact));
    if (is_axial) add(axial_contact(*joint, radius.nominal()));
    const bool is_spatial = is_ball || is_axial;
    const Vector3<double> z = is_ball ? Vector3<double>(0.0, 0.0, 1.0) : axis_of(*joint),
                          x = is_ball ? Vector3<double>(1.0, 0.0, 0.0)
                                      : transverse_axis<double>(z, std::nullopt);
    let(joint, "x", JointType::kPrismatic, x);
    let(joint, "y", JointType::kPrismatic, z.cross(x));
    if (is_spatial) let(joint, "z", JointType::kPrismatic, z);
  }

  /// The collars of a journal, as a ball of any radius between two planes.
  ContactDescription axial_contact(const JointDescription& joint, double radius) const {
    if (element_.has("youngs_modulus"))
      element_.fail_at("youngs_modulus", "Hertz's stiffness has no radius along the axis",
                       "stiffness in place of youngs_modulus; or no axial");
    ContactDescription contact =
        contact_of(joint, joint.name + "_axial_clearance",
                   read_quantity(element_, "axial", Range::kPositive, context_.table));
    contact.surface.shape = ShapeKind::kSlot;
    contact.surface.length = 2.0 * radius;
    contact.points.radius = radius;
    contact.surface.axes = axes_;
    return contact;
  }

  /// Block and guide, which play across x''.
  void guide(JointDescription* joint) {
    refuse("axial", "a hinge");
    refuse("radius", "a hinge or ball");
    const Quantity length = read_quantity(element_, "length", Range::kPositive, context_.table),
                   width = read_quantity(element_, "width", Range::kPositive, context_.table);
    if (element_.has("transverse_axis"))
      axes_.transverse = read_transverse_axis(element_, joint->axis);
    ContactDescription contact = contact_of(*joint, clearance_contact(joint->name), radial_);
    contact.surface.shape = ShapeKind::kSlot;
    contact.surface.length = width;
    contact.surface.axes = contact.points.axes = axes_;
    contact.surface.axes->across = true;
    contact.points.shape = ShapeKind::kBox;
    contact.points.size = {width, width, length};
    add(std::move(contact));
    const Vector3<double> z = axis_of(*joint), x = transverse_axis<double>(z, axes_.transverse);
    let(joint, "x", JointType::kPrismatic, x);
    if (joint->is_loop)
      let(joint, "turn", JointType::kContinuous, z.cross(x));
    else
      turn_child(joint, z.cross(x));
  }

  /// An attribute of another joint's clearance.
  void refuse(const char* attribute, const char* of) const {
    if (element_.has(attribute))
      element_.fail_at(attribute, std::string("a joint of this type has no ") + attribute,
                       std::string("no such attribute; it is for the clearance of ") + of);
  }

  /// The slides of the tree have constant axes.
  Vector3<double> axis_of(const JointDescription& joint) const {
    for (const Quantity& part : joint.axis)
      if (!part.is_constant())
        element_.fail("the axis of a joint with clearance depends on a parameter", "",
                      "an axis of plain numbers");
    return axis_at(joint.axis, std::vector<double>());
  }

  /// The names that the clearance gives are no one else's.
  void require_free(const std::string& name) const {
    const auto has = [&name](const auto& elements) {
      return std::any_of(elements.begin(), elements.end(),
                         [&name](const auto& element) { return element.name == name; });
    };
    if (has(robot_.links) || has(robot_.joints) || has(robot_.contacts))
      element_.fail("the clearance adds elements of a name that is taken", name,
                    "another name of that link, joint or contact, or of this joint");
  }

  ContactDescription contact_of(const JointDescription& joint, std::string name,
                                const Quantity& clearance) const {
    ContactDescription contact;
    contact.name = std::move(name);
    require_free(contact.name);
    contact.where = element_.where();
    contact.clearance = element_.label();
    contact.surface.link = joint.parent;
    contact.surface.origin = joint.origin;
    contact.surface.clearance = clearance;
    contact.points.link = joint.child;
    contact.points.origin = joint.child_origin;
    return contact;
  }

  void add(ContactDescription contact) {
    for (ContactEnd* const end : {&contact.surface, &contact.points})
      read_material(element_, context_, end);
    read_contact_force(element_, context_, &contact);
    robot_.contacts.push_back(std::move(contact));
  }

  /// A link without mass. Below a joint of the tree it is folded away; below a loop it stays, so
  /// that the start closes the loop as without clearance.
  int add_link(const std::string& name, bool stays) {
    require_free(name);
    LinkDescription link;
    link.name = name;
    link.where = element_.where();
    link.stays = stays;
    robot_.links.push_back(std::move(link));
    return static_cast<int>(robot_.links.size()) - 1;
  }

  JointDescription play(const std::string& name, JointType type,
                        const Vector3<double>& axis) const {
    JointDescription play;
    play.name = name;
    play.type = type;
    play.axis = constant(axis);
    play.is_play = true;
    play.where = element_.where();
    return play;
  }

  /// Lets the joint's parent move.
  void let(JointDescription* joint, const char* way, JointType type, const Vector3<double>& axis) {
    JointDescription free = play(play_of(joint->name, way), type, axis);
    free.parent = joint->parent;
    free.child = add_link(free.name, joint->is_loop);
    free.origin = joint->origin;
    joint->parent = free.child;
    joint->origin = PoseDescription();
    joints.push_back(std::move(free));
  }

  /// Lets the joint's child turn.
  void turn_child(JointDescription* joint, const Vector3<double>& axis) {
    JointDescription free = play(play_of(joint->name, "turn"), JointType::kContinuous, axis);
    free.child = joint->child;
    free.parent = joint->child = add_link(free.name, false);
    joints.push_back(std::move(free));
  }

  XmlElement element_;
  const ReadContext& context_;
  RobotDescription& robot_;
  Quantity radial_;
  ShapeAxes axes_;
};

/// Reads what stands beside radial="0", so that its errors show, and adds nothing.
void discard(const XmlElement& element, const ReadContext& context, RobotDescription robot,
             JointDescription joint) {
  const auto* const first = element.node()->FirstAttribute();
  if (first->Next() == nullptr) return;
  joint.friction.reset();
  joint.actuator.reset();
  for (Quantity& part : joint.axis) part = part.nominal();
  ClearanceReader(element, context, &robot).read(0.0, &joint);
}

}  // namespace

void read_clearances(const XmlElement& robot, const ReadContext& context,
                     RobotDescription* description) {
  std::vector<JointDescription> added;
  for (const char* tag : {"joint", "loop"})
    for (const XmlElement& of : robot.children(tag)) {
      const std::optional<XmlElement> element = of.child("codesign:clearance");
      const int k = joint_named(*description, of.text("name"));
      if (!element || k < 0) continue;
      JointDescription& joint = description->joints[to_index(k)];
      const Quantity radial = read_quantity(*element, "radial", Range::kNonNegative, context.table);
      if (!joint.has_one_coordinate() && !(joint.is_loop && joint.type == JointType::kSpherical))
        element->fail("a joint of this type has no clearance", of.find("type").value_or(""),
                      "revolute, continuous and prismatic joints and loops, loops of type "
                      "codesign:spherical; else a <codesign:contact>");
      if (radial.is_zero()) {
        discard(*element, context, *description, joint);
        continue;
      }
      if (radial.nominal() == 0.0)
        element->fail_at("radial", "a clearance that depends on a parameter is zero",
                         "> 0; or the plain number 0, the joint without clearance");
      ClearanceReader reader(*element, context, description);
      reader.read(radial, &joint);
      added.insert(added.end(), reader.joints.begin(), reader.joints.end());
    }
  const auto first_loop = std::find_if(description->joints.begin(), description->joints.end(),
                                       [](const JointDescription& joint) { return joint.is_loop; });
  description->joints.insert(first_loop, added.begin(), added.end());
}

}  // namespace codesign
