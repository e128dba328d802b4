// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <tuple>

#include "math/arrays.h"
#include "mechanism/pose.h"
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/quantity_reader.h"

namespace codesign {
namespace {

const char kRemedy[] =
    "write the <loop> or <coupling> that is meant (doc/annotations.md), or remove the element";

bool is_taken(const RobotDescription& robot, const std::string& name) {
  const auto same = [&name](const auto& other) { return other.name == name; };
  return std::any_of(robot.joints.begin(), robot.joints.end(), same) ||
         std::any_of(robot.couplings.begin(), robot.couplings.end(), same);
}

/// The constraint's name. If it has none or the name is taken, a number is appended to it or to
/// `constraint`.
std::string name_of(const XmlElement& element, const RobotDescription& robot) {
  const std::string wanted = element.find("name").value_or("");
  const std::string base = wanted.empty() ? "constraint" : wanted;
  std::string name = base;
  for (int k = 1; is_taken(robot, name); ++k) name = base + "_" + std::to_string(k);
  return name;
}

JointDescription read_position(const XmlElement& element, const ReadContext& context,
                               const RobotDescription& robot) {
  JointDescription loop;
  loop.is_loop = true;
  loop.type = JointType::kSpherical;
  loop.where = element.where();
  loop.name = name_of(element, robot);
  std::tie(loop.parent, loop.child) = context.ends(element);
  loop.origin = read_origin(element.only("predecessor"), context.table);
  loop.child_origin = read_origin(element.only("successor"), context.table);
  return loop;
}

/// Distance [m] of the contact point of one end from the axis of the joint above its link; 0 if
/// there is no such joint.
double radius_of(const XmlElement& end, int link, const RobotDescription& robot,
                 const ParameterTable& table) {
  const Vector3<double> point = vector_at(read_origin(end, table).xyz, table.values);
  for (const JointDescription& joint : robot.joints)
    if (!joint.is_loop && joint.child == link)
      return point.cross(axis_at(joint.axis, table.values)).norm();
  return 0.0;
}

/// The link that an end of the constraint names; SDF's and URDF's joints call the ends parent and
/// child.
std::string end_link(const XmlElement& element, const char* tag, const char* other) {
  const std::optional<XmlElement> end =
      element.child(tag) ? element.child(tag) : element.child(other);
  return end ? end->find("link").value_or("") : "";
}

/// Whether a `<loop>` between the constraint's two links takes its place.
bool has_loop(const XmlElement& element, const RobotDescription& robot) {
  return has_loop_between(robot, end_link(element, "predecessor", "parent"),
                          end_link(element, "successor", "child"));
}

CouplingDescription read_rolling(const XmlElement& element, const ReadContext& context,
                                 const RobotDescription& robot) {
  CouplingDescription coupling;
  coupling.where = element.where();
  coupling.name = name_of(element, robot);
  std::tie(coupling.predecessor, coupling.successor) = context.ends(element);
  const double ratio = rolling_ratio(element, coupling, robot, context.table);
  if (ratio == 0.0) element.only("ratio").fail_at("value", "the ratio is zero", "any other number");
  coupling.ratio = ratio;
  return coupling;
}

}  // namespace

bool has_loop_between(const RobotDescription& robot, const std::string& a, const std::string& b) {
  const auto name = [&robot](int link) { return robot.links[to_index(link)].name; };
  return std::any_of(robot.joints.begin(), robot.joints.end(), [&](const JointDescription& joint) {
    return joint.is_loop && ((name(joint.parent) == a && name(joint.child) == b) ||
                             (name(joint.parent) == b && name(joint.child) == a));
  });
}

double rolling_ratio(const XmlElement& element, const CouplingDescription& coupling,
                     const RobotDescription& robot, const ParameterTable& table) {
  if (const std::optional<XmlElement> ratio = element.child("ratio"))
    return read_number(*ratio, "value", Range::kAny);
  const double predecessor =
      radius_of(element.only("predecessor"), coupling.predecessor, robot, table);
  const double successor = radius_of(element.only("successor"), coupling.successor, robot, table);
  return predecessor > 0.0 && successor > 0.0 ? predecessor / successor : 1.0;
}

void read_constraints(const XmlElement& robot, const ReadContext& context,
                      RobotDescription* description) {
  for (const XmlElement& element : robot.children("constraint")) {
    const std::string type = element.find("type").value_or("");
    try {
      if (type == "position" || type == "spherical_joint") {
        description->joints.push_back(read_position(element, context, *description));
      } else if (type == "rolling") {
        description->couplings.push_back(read_rolling(element, context, *description));
      } else {
        if (!has_loop(element, *description))
          context.warnings->push_back(element.warning(
              "loop_ignored", "a <constraint> of an unknown type is ignored", type, kRemedy));
      }
    } catch (const InputError& error) {
      if (has_loop(element, *description)) continue;
      InputFault fault = error.fault();
      fault.message = std::string("a <constraint> that cannot be read is ignored: ") +
                      fault.message + "; to silence this: " + kRemedy;
      context.warnings->push_back(warn("loop_ignored", fault));
    }
  }
}

}  // namespace codesign
