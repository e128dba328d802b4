// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joint_reader.h"

#include <map>

#include "friction_reader.h"
#include "mechanism_codesign/math/decimal.h"
#include "mechanism_codesign/model/unknown_name.h"
#include "quantity_reader.h"

namespace codesign {
namespace {

JointType read_type(const XmlElement& element) {
  static const std::map<std::string, JointType> kTypes = {{"fixed", JointType::kFixed},           {"revolute", JointType::kRevolute},
                                                          {"continuous", JointType::kContinuous}, {"prismatic", JointType::kPrismatic},
                                                          {"planar", JointType::kPlanar},         {"floating", JointType::kFloating}};
  const std::string name = element.text("type");
  const auto found = kTypes.find(name);
  if (found != kTypes.end()) return found->second;
  std::vector<std::string> known;
  known.reserve(kTypes.size());
  for (const auto& type : kTypes) known.push_back(type.first);
  throw unknown_name(element.where("type"), element.label(), "joint type", name, known);
}

bool has_one_coordinate(JointType type) {
  return type == JointType::kRevolute || type == JointType::kContinuous || type == JointType::kPrismatic;
}

LimitDescription read_limit(const XmlElement& element, const ParameterTable& table) {
  LimitDescription limit;
  limit.lower = read_quantity_or(0.0, element, "lower", Range::kAny, table);
  limit.upper = read_quantity_or(0.0, element, "upper", Range::kAny, table);
  limit.effort = read_quantity(element, "effort", Range::kNonNegative, table);
  limit.velocity = read_quantity(element, "velocity", Range::kNonNegative, table);
  if (limit.lower.nominal() > limit.upper.nominal())
    element.fail_at(element.has("lower") ? "lower" : "upper", "the lower limit is above the upper limit",
                    "lower <= upper=" + to_decimal(limit.upper.nominal()));
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

void read_limit_and_mimic(const XmlElement& element, const ParameterTable& table, JointDescription* joint) {
  const std::optional<XmlElement> limit = element.child("limit"), mimic = element.child("mimic");
  const bool bounded = joint->type == JointType::kRevolute || joint->type == JointType::kPrismatic;
  if (bounded && !limit) element.fail("a joint of this type needs a <limit>", element.text("type"));
  if (limit) joint->limit = read_limit(*limit, table);
  if (!mimic) return;
  if (!has_one_coordinate(joint->type))
    mimic->fail("a joint of this type cannot mimic", element.text("type"), "revolute, continuous or prismatic");
  joint->mimic = read_mimic(*mimic, table);
}

}  // namespace

void read_joint_parts(const XmlElement& element, const ReadContext& context, JointDescription* joint) {
  const ParameterTable& table = context.table;
  const std::optional<XmlElement> axis = element.child("axis"), dynamics = element.child("dynamics");
  if (axis) joint->axis = read_axis(*axis, table);
  if (dynamics) {
    if (!dynamics->has("damping") && !dynamics->has("friction")) dynamics->fail("neither damping nor friction is given");
    joint->damping = read_quantity_or(0.0, *dynamics, "damping", Range::kNonNegative, table);
    joint->dry_friction = read_quantity_or(0.0, *dynamics, "friction", Range::kNonNegative, table);
  }
  const std::optional<XmlElement> friction = element.child("codesign:friction"), spring = element.child("codesign:torsion_spring");
  if (friction) joint->friction = read_friction(*friction, joint->axis, table);
  if (!spring) return;
  if (!has_one_coordinate(joint->type))
    spring->fail("a joint of this type has no coordinate for a spring", "", "revolute, continuous or prismatic");
  joint->spring = TorsionSpringDescription{read_quantity(*spring, "stiffness", Range::kNonNegative, table),
                                           read_quantity_or(0.0, *spring, "damping", Range::kNonNegative, table),
                                           read_quantity_or(0.0, *spring, "free_position", Range::kAny, table)};
}

JointDescription read_joint(const XmlElement& element, const ReadContext& context) {
  JointDescription joint;
  joint.where = element.where();
  joint.name = element.text("name");
  joint.type = read_type(element);
  const XmlElement child = element.only("child");
  joint.parent = context.link(element.only("parent"), "link");
  joint.child = context.link(child, "link");
  if (joint.parent == joint.child) child.fail_at("link", "parent and child are the same link", "two links");
  joint.origin = read_origin(element, context.table);
  read_joint_parts(element, context, &joint);
  read_limit_and_mimic(element, context.table, &joint);
  return joint;
}

}  // namespace codesign
