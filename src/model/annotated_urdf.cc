// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "annotated_urdf.h"

#include <tuple>

#include "annotation_rules.h"
#include "annotation_schema.h"
#include "inertial_reader.h"
#include "joint_reader.h"
#include "overlay.h"
#include "parameter_reader.h"
#include "quantity_reader.h"
#include "tree_check.h"
#include "urdfdom_check.h"

namespace codesign {
namespace {

/// Every twin of the file, also where nothing of it is simulated (visuals): the tuned file will show its value.
void check_twins(const XmlElement& element, const std::string& path, const ParameterTable& table) {
  const ElementRule* rule = find_rule(path);
  if (rule != nullptr) {
    for (const std::string& name : rule->twins) {
      if (!element.has(kPrefix + name)) continue;
      const bool is_vector = name == "xyz" || name == "rpy" || name == "size";
      read_quantities(element, name, is_vector ? 3 : 1, table);
    }
  }
  for (const XmlElement& child : element.children()) check_twins(child, path + "/" + child.tag(), table);
}

LinkDescription read_link(const XmlElement& element, const ParameterTable& table) {
  LinkDescription link;
  link.where = element.where();
  link.name = element.text("name");
  link.inertial = read_inertial(element, table);
  return link;
}

CouplingDescription read_coupling(const XmlElement& element, const ReadContext& context) {
  CouplingDescription coupling;
  coupling.where = element.where();
  coupling.name = element.text("name");
  std::tie(coupling.predecessor, coupling.successor) = context.ends(element);
  const XmlElement ratio = element.only("ratio");
  coupling.ratio = read_quantity(ratio, "value", Range::kAny, context.table);
  if (coupling.ratio.nominal() == 0.0) ratio.fail_at("value", "the ratio is zero", "any other number");
  return coupling;
}

SpringDamperDescription read_spring_damper(const XmlElement& element, const ReadContext& context) {
  SpringDamperDescription spring;
  spring.where = element.where();
  spring.name = element.text("name");
  std::tie(spring.predecessor, spring.successor) = context.ends(element);
  spring.predecessor_origin = read_origin(element.only("predecessor"), context.table);
  spring.successor_origin = read_origin(element.only("successor"), context.table);
  spring.stiffness = read_quantity(element, "stiffness", Range::kNonNegative, context.table);
  spring.damping = read_quantity_or(0.0, element, "damping", Range::kNonNegative, context.table);
  spring.free_length = read_quantity_or(0.0, element, "free_length", Range::kNonNegative, context.table);
  return spring;
}

}  // namespace

XmlDocument load_annotated_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays) {
  XmlDocument document(urdf);
  check_namespace(document);
  for (const SourceText& text : overlays) {
    const XmlDocument overlay(text);
    check_namespace(overlay);
    merge_overlay(overlay, &document);
  }
  check_annotations(document);
  return document;
}

RobotDescription read_robot(const XmlDocument& document) {
  const XmlElement element(document.robot(), &document);
  RobotDescription robot;
  robot.file = document.file();
  robot.name = element.text("name");
  robot.parameters = read_parameters(element);
  ReadContext context{{}, ParameterTable(robot.parameters)};
  for (const XmlElement& link : element.children("link")) robot.links.push_back(read_link(link, context.table));
  if (robot.links.empty()) element.fail("the robot has no links");
  for (const LinkDescription& link : robot.links) context.links.push_back(link.name);
  for (const XmlElement& joint : element.children("joint")) robot.joints.push_back(read_joint(joint, context));
  for (const XmlElement& loop : element.children("loop")) robot.joints.push_back(read_loop(loop, context));
  for (const XmlElement& coupling : element.children("coupling")) robot.couplings.push_back(read_coupling(coupling, context));
  for (const XmlElement& spring : element.children("codesign:spring_damper"))
    robot.spring_dampers.push_back(read_spring_damper(spring, context));
  check_twins(element, "robot", context.table);
  check_names(robot);
  robot.root = find_root(robot);
  check_mimics(robot);
  check_friction(robot);
  check_with_urdfdom(document.file(), document.text());
  return robot;
}

}  // namespace codesign
