// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include <algorithm>
#include <tuple>

#include "reading/urdf/quantity_reader.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {

int ReadContext::link(const XmlElement& element, const std::string& attribute) const {
  const std::string name = element.text(attribute);
  if (const auto known = link_indices.find(name); known != link_indices.end()) return known->second;
  const auto found = std::find(links.begin(), links.end(), name);
  if (found == links.end())
    throw unknown_name(element.where(attribute), element.label(), "link", name, links);
  return static_cast<int>(found - links.begin());
}

std::pair<int, int> ReadContext::ends(const XmlElement& element) const {
  const XmlElement successor = element.only("successor");
  const std::pair<int, int> result = {link(element.only("predecessor"), "link"),
                                      link(successor, "link")};
  if (result.first == result.second)
    successor.fail_at("link", "predecessor and successor are the same link", "two links");
  return result;
}

namespace {

/// A number that must not be negative. A negative one is an error in an overlay; in a vendor's file
/// it is taken as zero with a warning, since exporters write it for unknown values. @param meaning
/// what zero means there.
Quantity read_magnitude(const XmlElement& element, const std::string& attribute,
                        const ReadContext& context, const char* meaning = "is taken as zero") {
  Quantity value = read_quantity(element, attribute,
                                 element.in_overlay(attribute) ? Range::kNonNegative : Range::kAny,
                                 context.table);
  if (value.nominal() >= 0.0) return value;
  context.warnings->push_back(element.warning_at("negative_value", attribute,
                                                 attribute + " is negative and " + meaning,
                                                 "write 0 or a positive number"));
  return 0.0;
}

Quantity read_magnitude_or_zero(const XmlElement& element, const std::string& attribute,
                                const ReadContext& context) {
  return element.has(attribute) ? read_magnitude(element, attribute, context) : Quantity(0.0);
}

void check_bounds(const XmlElement& element, const JointLaw& law, const ReadContext& context,
                  LimitDescription* limit) {
  if (!limit->bounds_position()) return;
  if (!law.needs_limit) {
    context.warnings->push_back(element.warning(
        "limit_ignored", "lower and upper are ignored, since a continuous joint turns without end",
        element.find("lower").value_or("0") + " ... " + element.find("upper").value_or("0"),
        "leave them out, or write type=\"revolute\""));
    return;
  }
  if (limit->lower.nominal() <= limit->upper.nominal()) return;
  const std::string attribute = element.has("lower") ? "lower" : "upper";
  const std::string message = "the lower limit is above the upper limit";
  if (element.in_overlay(attribute))
    element.fail_at(attribute, message, "lower <= upper=" + to_decimal(limit->upper.nominal()));
  context.warnings->push_back(element.warning_at(
      "limits_reversed", attribute,
      message + " (" + to_decimal(limit->upper.nominal()) + "): the joint has no stops",
      "exchange the two, or leave them out"));
  limit->lower = limit->upper = 0.0;
}

LimitDescription read_limit(const XmlElement& element, const JointLaw& law,
                            const ReadContext& context) {
  LimitDescription limit;
  limit.lower = read_quantity_or(0.0, element, "lower", Range::kAny, context.table);
  limit.upper = read_quantity_or(0.0, element, "upper", Range::kAny, context.table);
  // In SDF, and in files converted from it, a negative limit is not enforced; its default is -1.
  const char* const no_limit = "means, as in SDF, that there is no limit";
  limit.effort = read_magnitude(element, "effort", context, no_limit);
  limit.velocity = read_magnitude(element, "velocity", context, no_limit);
  check_bounds(element, law, context, &limit);
  return limit;
}

MimicDescription read_mimic(const XmlElement& element, const ParameterTable& table) {
  MimicDescription mimic;
  mimic.joint = element.text("joint");
  mimic.multiplier = read_quantity_or(1.0, element, "multiplier", Range::kAny, table);
  mimic.offset = read_quantity_or(0.0, element, "offset", Range::kAny, table);
  mimic.where = element.where();
  return mimic;
}

/// Sets the transition velocities that are not given, of friction in N m or N and of gears: a
/// thousandth of the joint's largest speed if it has one, else they follow the machine. With
/// bristles they are Stribeck velocities, which are ten times as large.
void suit_transitions(const XmlElement& element, JointDescription* joint) {
  const bool bounded = joint->limit && joint->limit->bounds_velocity();
  const double largest = bounded            ? joint->limit->velocity.nominal()
                         : joint->is_turn() ? 1.0
                                            : 0.1;  // [rad/s, m/s]
  const auto suit = [&](const char* tag, FrictionDescription* friction) {
    const std::optional<XmlElement> child = element.child(tag);
    if (!child || child->has("transition_velocity")) return;
    const bool sticks = static_cast<bool>(friction->model->bristle);
    friction->transition_velocity = (sticks ? 0.01 : 0.001) * largest;
    friction->transition_follows = !bounded && !sticks;
  };
  if (joint->friction && joint->friction->is_direct) suit("codesign:friction", &*joint->friction);
  if (joint->actuator && joint->actuator->gear)
    suit("codesign:actuator", &joint->actuator->gear->slip);
}

void read_limit_of_joint(const XmlElement& element, const ReadContext& context,
                         JointDescription* joint) {
  const std::optional<XmlElement> limit = element.child("limit");
  if (joint->law().needs_limit && !limit)
    element.fail(
        "a joint of this type needs a <limit>", element.text("type"),
        "<limit lower=\"...\" upper=\"...\" effort=\"...\" velocity=\"...\"/>, or of a hinge "
        "without stops type=\"continuous\"");
  if (limit && joint->has_one_coordinate())
    joint->limit = read_limit(*limit, joint->law(), context);
  else if (limit && element.has("codesign:type"))
    limit->fail("a joint of this type has no single coordinate for a limit",
                element.text("codesign:type"), "revolute, continuous or prismatic");
}

void read_mimic_of_joint(const XmlElement& element, const ReadContext& context,
                         JointDescription* joint) {
  const std::optional<XmlElement> mimic = element.child("mimic");
  if (!mimic) return;
  if (joint->has_one_coordinate()) {
    joint->mimic = read_mimic(*mimic, context.table);
    return;
  }
  const std::string message = "a joint of this type cannot mimic";
  if (mimic->in_overlay())
    mimic->fail(message, element.text("type"), "revolute, continuous or prismatic");
  context.warnings->push_back(mimic->warning("mimic_ignored", message + ": the element is ignored",
                                             element.text("type"),
                                             "remove it, or write another type"));
}

/// Damping and dry friction of a joint. On planar and floating joints URDF gives them no meaning,
/// and they are ignored.
void read_dynamics(const XmlElement& dynamics, const ReadContext& context,
                   JointDescription* joint) {
  if (!dynamics.has("damping") && !dynamics.has("friction"))
    dynamics.fail("neither damping nor friction is given", "",
                  "damping=\"...\", friction=\"...\", or no <dynamics>");
  joint->damping = read_magnitude_or_zero(dynamics, "damping", context);
  joint->dry_friction = read_magnitude_or_zero(dynamics, "friction", context);
  joint->armature = read_magnitude_or_zero(dynamics, "armature", context);
  if (!joint->has_pose() || dynamics.in_overlay()) return;
  if (!joint->damping.is_zero() || !joint->dry_friction.is_zero())
    context.warnings->push_back(dynamics.warning(
        "dynamics_ignored",
        "damping and friction of a joint with several coordinates are ignored: it moves freely", "",
        "remove the element"));
  joint->damping = joint->dry_friction = joint->armature = 0.0;
}

/// That of an actuator takes the place of that of `<dynamics>`, which is its rotor told otherwise.
void read_armature(const XmlElement& element, const ReadContext& context, JointDescription* joint) {
  const std::optional<XmlElement> actuator = element.child("codesign:actuator"),
                                  dynamics = element.child("dynamics");
  if (actuator)
    joint->armature =
        read_quantity_or(0.0, *actuator, "armature", Range::kNonNegative, context.table);
  else if (dynamics && !dynamics->in_overlay("armature") && !joint->armature.is_zero())
    context.warnings->push_back(dynamics->warning_at(
        "armature_read", "armature",
        "the armature counts as an inertia of the joint's coordinate alone, as in MuJoCo",
        "write it into <codesign:actuator armature=\"...\"/>, or gear_ratio and rotor_inertia "
        "there"));
}

// JointType begins with those.
bool is_type_of_urdf(JointType type) { return type <= JointType::kFloating; }

/// Says how a joint of other formats is written. @throws InputError
void refuse_foreign_type(const XmlElement& element, const std::string& name) {
  if (name == "ball" || name == "codesign:spherical")
    element.fail_at("type", "URDF has no ball joint",
                    "type=\"floating\" codesign:type=\"spherical\"");
  if (name == "codesign:cylindrical")
    element.fail_at("type", "URDF has no cylindrical joint",
                    "type=\"floating\" codesign:type=\"cylindrical\"");
  if (name == "universal" || name == "revolute2")
    element.fail_at("type", "URDF has no joint with two axes",
                    "two continuous joints through a link without <inertial>");
  if (name == "screw")
    element.fail_at("type", "URDF has no screw",
                    "a continuous joint, a link without <inertial>, and a prismatic joint with "
                    "<mimic> of the first one");
}

/// Reads the attribute `type` of a joint, or of a loop if `joint` is one; of a joint that URDF does
/// not have, `codesign:type`. @throws InputError
void read_joint_type(const XmlElement& element, const Laws& laws, JointDescription* joint) {
  const bool is_own = !joint->is_loop && element.has("codesign:type");
  const char* const attribute = is_own ? "codesign:type" : "type";
  if (is_own && element.text("type") != "floating")
    element.fail_at("type", "a joint with codesign:type must be floating for other readers",
                    "type=\"floating\"");
  const std::string name = element.text(attribute);
  std::vector<std::string> known;
  for (const RowReference<JointLaw>& law : laws.joints) {
    const char* const spelling = joint->is_loop ? law->of_loops : law->of_joints;
    if (spelling == nullptr) continue;
    const bool is_refused = !is_own && !joint->is_loop && !is_type_of_urdf(law->type);
    if (!is_refused) known.emplace_back(spelling);
    if (name != spelling) continue;
    if (is_refused)
      element.fail_at(attribute, "other readers of URDF refuse a joint of this type",
                      "type=\"floating\" codesign:type=\"" + name + "\"");
    joint->type = law->type;
    if (law->type == JointType::kOther) joint->own_kind = pair_of(*law);
    return;
  }
  if (!is_own && !joint->is_loop) refuse_foreign_type(element, name);
  throw unknown_name(element.where(attribute), element.label(),
                     joint->is_loop ? "loop type" : "joint type", name, known);
}

/// Reads the parts that joints and loops have in common: axis, dynamics, friction, actuator and
/// torsion spring.
/// @param joint its type and links must be set. @throws InputError
void read_joint_parts(const XmlElement& element, const ReadContext& context,
                      JointDescription* joint) {
  const ParameterTable& table = context.table;
  // Other readers of URDF ignore the rest of a fixed joint.
  const bool welded = joint->is_fixed() && !joint->is_loop;
  const std::optional<XmlElement> axis = element.child("axis"),
                                  dynamics = element.child("dynamics");
  if (axis && !welded && (joint->freedoms().turns < 3 || joint->is_loop))
    joint->axis = read_axis(*axis, table);
  if (dynamics && !welded) read_dynamics(*dynamics, context, joint);
  const std::optional<XmlElement> friction = element.child("codesign:friction"),
                                  spring = element.child("codesign:torsion_spring");
  const std::optional<XmlElement> actuator = element.child("codesign:actuator");
  if (friction) joint->friction = read_friction(*friction, joint->axis, context);
  if (actuator) joint->actuator = read_actuator(*actuator, joint->law(), context);
  if (joint->has_one_coordinate())
    read_armature(element, context, joint);
  else if (!joint->armature.is_zero())
    dynamics->fail_at("armature", "a joint of this type has no single coordinate for an armature",
                      "revolute, continuous or prismatic");
  if (joint->is_loop && joint->has_elastic_gear())
    actuator->fail_at("stiffness",
                      "an elastic gear needs a joint of the tree, which gives its motor a start",
                      "no stiffness; or a tree with this joint, and a <loop> elsewhere");
  if (!spring) return;
  if (!joint->has_one_coordinate())
    spring->fail("a joint of this type has no single coordinate for a spring", "",
                 "revolute, continuous or prismatic");
  joint->spring = TorsionSpringDescription{
      read_quantity(*spring, "stiffness", Range::kNonNegative, table),
      read_quantity_or(0.0, *spring, "damping", Range::kNonNegative, table),
      read_quantity_or(0.0, *spring, "free_position", Range::kAny, table)};
}

void read_type_specific(const XmlElement& element, const ReadContext& context,
                        JointDescription* loop) {
  const std::optional<XmlElement> second_axis = element.child("codesign:second_axis"),
                                  length = element.child("codesign:length");
  if (second_axis) {
    if (loop->type != JointType::kUniversal)
      second_axis->fail("only a loop of type codesign:universal has a second axis",
                        element.text("type"), "type=\"codesign:universal\", or no second axis");
    loop->second_axis = read_axis(*second_axis, context.table);
  }
  if (length && loop->type != JointType::kDistance)
    length->fail("only a loop of type codesign:distance has a length", element.text("type"),
                 "type=\"codesign:distance\", or no length");
  if (loop->type == JointType::kDistance)
    loop->distance =
        read_quantity(element.only("codesign:length"), "value", Range::kPositive, context.table);
}

/// Whether a loop says `codesign:out_of_plane="zero"`.
bool read_out_of_plane(const XmlElement& element, const ReadContext& context,
                       const JointDescription& loop) {
  const char* const attribute = "codesign:out_of_plane";
  const std::string given = element.find(attribute).value_or("shared");
  if (given != "zero" && given != "shared")
    element.fail_at(attribute, "unknown statement about what acts out of the plane",
                    "zero or shared");
  if (given == "shared" || kind_of(loop)->in_plane) return given == "zero";
  std::string types;
  for (const RowReference<JointLaw>& law : context.laws->joints)
    if (law->of_loops && law->in_plane)
      types += (types.empty() ? "" : ", ") + std::string(law->of_loops);
  element.fail_at(attribute,
                  "a loop of type " + element.text("type") + " cannot be held in a plane only",
                  "loops of type " + types);
}

}  // namespace

JointDescription read_joint(const XmlElement& element, const ReadContext& context) {
  JointDescription joint;
  joint.where = element.where();
  joint.name = element.text("name");
  read_joint_type(element, *context.laws, &joint);
  const XmlElement child = element.only("child");
  joint.parent = context.link(element.only("parent"), "link");
  joint.child = context.link(child, "link");
  if (joint.parent == joint.child)
    child.fail_at("link", "parent and child are the same link", "two links");
  joint.origin = read_origin(element, context.table);
  read_joint_parts(element, context, &joint);
  read_limit_of_joint(element, context, &joint);
  read_mimic_of_joint(element, context, &joint);
  suit_transitions(element, &joint);
  return joint;
}

JointDescription read_loop(const XmlElement& element, const ReadContext& context) {
  JointDescription loop;
  loop.is_loop = true;
  loop.where = element.where();
  loop.name = element.text("name");
  read_joint_type(element, *context.laws, &loop);
  std::tie(loop.parent, loop.child) = context.ends(element);
  loop.origin = read_origin(element.only("predecessor"), context.table);
  loop.child_origin = read_origin(element.only("successor"), context.table);
  read_joint_parts(element, context, &loop);
  read_type_specific(element, context, &loop);
  loop.in_plane = read_out_of_plane(element, context, loop);
  suit_transitions(element, &loop);
  return loop;
}

}  // namespace codesign
