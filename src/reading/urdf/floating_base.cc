// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/floating_base.h"

#include <algorithm>

#include "math/arrays.h"
#include "mechanism/fixed_base.h"

namespace codesign {
namespace {

constexpr const char* kWorld = "world";

std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else if (c == '"')
      text += "&quot;";
    else
      text += c;
  }
  return text;
}

bool floats(const RobotDescription& robot) {
  return std::any_of(robot.joints.begin(), robot.joints.end(), [&](const JointDescription& joint) {
    return joint.name == kFloatingBaseJoint && joint.type == JointType::kFloating &&
           joint.parent == robot.root;
  });
}

}  // namespace

std::vector<SourceText> with_floating_base(const RobotDescription& robot,
                                           std::vector<SourceText> overlays) {
  if (floats(robot)) return overlays;
  const LinkDescription& root = robot.links[to_index(robot.root)];
  const std::string element = "<link name=\"" + root.name + "\">";
  if (!(mass_of_base(robot) > 0.0))
    throw InputError({root.where, element,
                      "the base shall float, but the root link and what is fixed to it have no "
                      "mass",
                      root.name,
                      "an <inertial> of the root link, or of a link that is fixed to it; a model "
                      "whose base hangs on a floating joint of its own needs no base: floating"});
  const auto is_taken = [&](const auto& items, const char* name) {
    return std::any_of(items.begin(), items.end(),
                       [name](const auto& item) { return item.name == name; });
  };
  if (is_taken(robot.links, kWorld) || is_taken(robot.joints, kFloatingBaseJoint))
    throw InputError({root.where, element,
                      "the base shall float, but the model has a link or a joint of the name that "
                      "it then needs",
                      is_taken(robot.links, kWorld) ? kWorld : kFloatingBaseJoint,
                      "another name; or the floating joint of the base in an overlay"});
  overlays.push_back({kFloatingBase, "<robot name=\"" + escaped(robot.name) + "\"><link name=\"" +
                                         kWorld + "\"/><joint name=\"" + kFloatingBaseJoint +
                                         "\" type=\"floating\"><parent link=\"" + kWorld +
                                         "\"/><child link=\"" + escaped(root.name) +
                                         "\"/></joint></robot>\n"});
  return overlays;
}

}  // namespace codesign
