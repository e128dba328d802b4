// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_reader.h"

#include <algorithm>
#include <tuple>

#include "description/robot.h"
#include "mechanism/constants.h"
#include "reading/urdf/inertial_reader.h"
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/overlay.h"
#include "reading/urdf/quantity_reader.h"
#include "reading/urdf/urdf_checks.h"
#include "reading/urdf/vocabulary.h"
#include "text/told_once.h"

namespace codesign {
namespace {

/// Checks every twin, also the twins of visuals, which are not simulated: write_tuned_urdf() writes
/// their values.
void check_twins(const XmlElement& element, const std::string& path, const ParameterTable& table) {
  const ElementRule* rule = find_rule(path);
  if (rule != nullptr) {
    for (const std::string& name : rule->twins) {
      if (!element.has(kPrefix + name)) continue;
      read_quantities(element, name, words_of(name), table);
    }
  }
  for (const XmlElement& child : element.children())
    check_twins(child, path + "/" + child.tag(), table);
}

LinkDescription read_link(const XmlElement& element, const ParameterTable& table) {
  LinkDescription link;
  link.where = element.where();
  link.name = element.text("name");
  link.inertial = read_inertial(element, table);
  return link;
}

CouplingDescription read_coupling(const XmlElement& element, const ReadContext& context,
                                  const RobotDescription& robot) {
  CouplingDescription coupling;
  coupling.where = element.where();
  coupling.name = element.text("name");
  std::tie(coupling.predecessor, coupling.successor) = context.ends(element);
  const bool rolls = element.has("type");
  if (rolls && element.text("type") != "rolling")
    element.fail_at("type", "the type of the coupling is unknown", "rolling, or no type");
  for (const char* end : {"predecessor", "successor"})
    if (const auto origin = element.only(end).child("origin"); origin && !rolls)
      origin->fail("only a coupling of type rolling has points, and a ratio without them", "",
                   "<ratio value=\"...\"/> alone");
  if (rolls && !element.child("ratio")) {
    coupling.ratio = rolling_ratio(element, coupling, robot, context.table);
    return coupling;
  }
  const XmlElement ratio = element.only("ratio");
  coupling.ratio = read_quantity(ratio, "value", Range::kAny, context.table);
  if (coupling.ratio.nominal() == 0.0)
    ratio.fail_at("value", "the ratio is zero", "any other number");
  return coupling;
}

/// Warns of rotors with a given ratio of 1 on links that move: their reaction turns the carrier,
/// and a reflected inertia was meant.
void warn_of_rotors(const XmlElement& robot, const RobotDescription& description,
                    Warnings* warnings) {
  for (const XmlElement& element : robot.children("joint")) {
    const std::optional<XmlElement> actuator = element.child("codesign:actuator");
    const int k = joint_named(description, element.text("name"));
    if (!actuator || !actuator->has("gear_ratio") || k < 0) continue;
    const JointDescription& joint = description.joints[to_index(k)];
    const Quantity& ratio = joint.actuator->gear_ratio;
    if (!ratio.is_constant() || ratio.nominal() != 1.0 || joint.parent == description.root ||
        joint.actuator->rotor_inertia.is_zero())
      continue;
    warnings->push_back(actuator->warning_at(
        "rotor_of_ratio_one", "gear_ratio",
        "with the ratio 1 the rotor turns as the joint does, and its reaction turns the link that "
        "carries it; a reflected inertia, gear_ratio^2 rotor_inertia, does not",
        "write a reflected inertia as armature=\"...\"; add that of a direct drive to the "
        "<inertial> of the child link"));
  }
}

/// Text or elements beside the `<robot>` of an overlay are an error, since they would be lost.
XmlDocument load_overlay(SourceText source) {
  Warnings beside = cut_trailing_text(&source);
  XmlDocument overlay(source);
  check_namespace(overlay);
  check_prefixes(overlay);
  refuse_text(overlay);
  append(check_surroundings(overlay), &beside);
  if (!beside.empty())
    throw InputError(
        {beside.front().where, "", "something stands after </robot>", "", "one <robot> element"});
  return overlay;
}

/// Sorts by file, the model's before overlays, and by line.
void sort_by_place(const std::string& file, Warnings* warnings) {
  std::stable_sort(warnings->begin(), warnings->end(), [&file](const Warning& a, const Warning& b) {
    const bool a_first = a.where.file == file, b_first = b.where.file == file;
    if (a_first != b_first) return a_first;
    return a.where.file == b.where.file && a.where.line < b.where.line;
  });
}

}  // namespace

XmlDocument load_annotated_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                                const Laws& laws, PlainNumbers plain) {
  SourceText text = urdf;
  const Warnings trailing = cut_trailing_text(&text);
  XmlDocument document(text);
  document.note(trailing);
  check_namespace(document);
  check_prefixes(document);
  document.note(check_surroundings(document));
  refuse_set_values(document);
  for (const SourceText& source : overlays) {
    const XmlDocument overlay = load_overlay(source);
    merge_overlay(overlay, &document);
  }
  if (plain == PlainNumbers::kFilledIn) fill_in_twins(&document);
  check_annotations(document);
  Warnings warnings;
  check_vocabulary(document, &warnings);
  document.note(warnings);
  write_out_densities(&document);
  write_out_free_inertias(&document);
  apply_set_values(&document, laws);
  return document;
}

RobotDescription read_robot(const XmlDocument& document, const Laws& laws) {
  const XmlElement element(document.robot(), &document);
  RobotDescription robot;
  robot.laws = laws;
  robot.file = document.file();
  robot.warnings = document.warnings();
  robot.name = element.text("name");
  robot.parameters = read_parameters(element);
  ReadContext context{{}, ParameterTable(robot.parameters), &robot.warnings, &laws};
  for (const XmlElement& link : element.children("link"))
    robot.links.push_back(read_link(link, context.table));
  if (robot.links.empty())
    element.fail("the robot has no links", "", "at least one <link name=\"...\">");
  for (const LinkDescription& link : robot.links) {
    context.link_indices.emplace(link.name, static_cast<int>(context.links.size()));
    context.links.push_back(link.name);
  }
  for (const XmlElement& joint : element.children("joint"))
    robot.joints.push_back(read_joint(joint, context));
  close_with_second_parents(&robot);
  for (const XmlElement& loop : element.children("loop"))
    robot.joints.push_back(read_loop(loop, context));
  for (const XmlElement& coupling : element.children("coupling"))
    robot.couplings.push_back(read_coupling(coupling, context, robot));
  read_constraints(element, context, &robot);
  for_each_link_element_kind(robot, [&](const LinkElementKind& kind, auto& elements) {
    for (const XmlElement& one : element.children(kind.tag))
      read_link_element(one, context, &elements.emplace_back());
  });
  read_clearances(element, context, &robot);
  read_transmissions(element, &robot);
  check_twins(element, "robot", context.table);
  robot.used_parameters = context.table.used;
  robot.switches = context.table.switches;
  check_names(robot);
  robot.root = find_root(robot);
  warn_of_rotors(element, robot, &robot.warnings);
  warn_of_foreign_loops(element, robot, &robot.warnings);
  check_mimics(&robot);
  check_bodies(robot, &robot.warnings);
  check_friction(robot);
  check_with_urdfdom(document);
  sort_by_place(robot.file, &robot.warnings);
  robot.warnings = told_once(robot.warnings);
  return robot;
}

RobotDescription read_urdf(const SourceText& urdf, const std::vector<SourceText>& overlays,
                           const Laws& laws) {
  return read_robot(load_annotated_urdf(urdf, overlays, laws), laws);
}

}  // namespace codesign
