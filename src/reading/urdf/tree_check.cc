// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "description/robot.h"
#include "math/arrays.h"
#include "mechanism/pair_geometry.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

std::string element_of(const LinkDescription& link) { return "<link name=\"" + link.name + "\">"; }

void insert_unique(const std::string& name, const SourceLocation& where, const std::string& kind,
                   std::set<std::string>* names) {
  if (!names->insert(name).second)
    throw InputError(
        {where, "<" + kind + ">", "a second " + kind + " of this name", name, "unique names"});
}

/// The tree joint above each link, null for roots.
std::vector<const JointDescription*> joints_above(const RobotDescription& robot) {
  std::vector<const JointDescription*> above(robot.links.size(), nullptr);
  for (const JointDescription& joint : robot.joints) {
    if (joint.is_loop) continue;
    const JointDescription*& slot = above[to_index(joint.child)];
    const std::string& link = robot.links[to_index(joint.child)].name;
    if (slot != nullptr)
      throw InputError({joint.where, joint.element(),
                        "its child " + link + " is already the child of the joint " + slot->name,
                        link, "one joint above each link; close the ring with a <loop>"});
    slot = &joint;
  }
  return above;
}

/// Per joint: whether a walk from the roots reaches its child by this joint first.
std::vector<bool> reached_first(const RobotDescription& robot, const std::vector<int>& parents) {
  std::vector<bool> reached(robot.links.size()), first(robot.joints.size(), false);
  for (std::size_t link = 0; link < parents.size(); ++link) reached[link] = parents[link] == 0;
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t k = 0; k < robot.joints.size(); ++k) {
      const auto parent = to_index(robot.joints[k].parent), child = to_index(robot.joints[k].child);
      if (!reached[parent] || reached[child]) continue;
      first[k] = reached[child] = progress = true;
    }
  }
  return first;
}

/// The fault of the chain of joints that `joint` mimics, directly or through others: an unknown
/// joint or a ring.
std::optional<InputError> mimic_fault(const JointDescription& joint,
                                      const std::map<std::string, const JointDescription*>& targets,
                                      const std::vector<std::string>& names) {
  std::size_t steps = 0;
  for (const JointDescription* at = &joint; at->mimic; at = targets.at(at->mimic->joint)) {
    const std::string element = at->element() + " <mimic>";
    if (targets.count(at->mimic->joint) == 0)
      return unknown_name(at->mimic->where, element, "joint to mimic", at->mimic->joint, names);
    if (++steps > names.size())
      return InputError({joint.mimic->where, joint.element() + " <mimic>",
                         "the joints mimic each other in a ring", joint.mimic->joint,
                         "a joint that does not follow this one, directly or through others"});
  }
  return std::nullopt;
}

}  // namespace

void check_names(const RobotDescription& robot) {
  std::set<std::string> links, joints, couplings;
  for (const LinkDescription& link : robot.links)
    insert_unique(link.name, link.where, "link", &links);
  for (const JointDescription& joint : robot.joints)
    insert_unique(joint.name, joint.where, joint.is_loop ? "loop" : "joint", &joints);
  for (const CouplingDescription& coupling : robot.couplings)
    insert_unique(coupling.name, coupling.where, "coupling", &couplings);
  std::set<std::string> taken = links;
  taken.insert(joints.begin(), joints.end());
  for_each_link_element_kind(robot, [&](const LinkElementKind& kind, const auto& elements) {
    std::set<std::string> own;
    for (const auto& element : elements) {
      insert_unique(element.name, element.where, kind.tag, &own);
      if (!kind.shares_names && taken.count(element.name) != 0)
        throw InputError({element.where,
                          "<" + std::string(kind.tag) + " name=\"" + element.name + "\">",
                          "a link, joint, loop or other element between links has this name, too, "
                          "so that its signals would be ambiguous",
                          element.name, "a name of its own"});
    }
    taken.insert(own.begin(), own.end());
  });
}

void close_with_second_parents(RobotDescription* robot) {
  std::vector<int> parents(robot->links.size(), 0);
  for (const JointDescription& joint : robot->joints) ++parents[to_index(joint.child)];
  if (std::none_of(parents.begin(), parents.end(), [](int count) { return count > 1; })) return;
  const std::vector<bool> in_tree = reached_first(*robot, parents);
  for (std::size_t k = 0; k < robot->joints.size(); ++k) {
    JointDescription& joint = robot->joints[k];
    if (in_tree[k] || parents[to_index(joint.child)] < 2 || joint.where.file != robot->file)
      continue;
    const std::string& child = robot->links[to_index(joint.child)].name;
    robot->warnings.push_back(
        warn("second_parent",
             {joint.where, joint.element(),
              "its child is already the child of another joint, so this one is read as a loop; to "
              "silence this: write a <loop> with predecessor and successor",
              child, ""}));
    joint.is_loop = true;
    joint.limit.reset();
    joint.mimic.reset();
  }
  std::stable_partition(robot->joints.begin(), robot->joints.end(),
                        [](const JointDescription& joint) { return !joint.is_loop; });
}

int find_root(const RobotDescription& robot) {
  const std::vector<const JointDescription*> above = joints_above(robot);
  int root = -1;
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    if (above[k] != nullptr) continue;
    if (root >= 0)
      throw InputError({robot.links[k].where, element_of(robot.links[k]),
                        "a second root: no joint has this link as its child",
                        robot.links[to_index(root)].name + ", " + robot.links[k].name,
                        "one root link"});
    root = static_cast<int>(k);
  }
  // Each link is passed twice at most: a walk ends at a link from which the root has been reached.
  std::vector<bool> reaches_root(robot.links.size(), false);
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    std::size_t link = k, steps = 0;
    const auto goes_on = [&](std::size_t at) { return above[at] != nullptr && !reaches_root[at]; };
    while (goes_on(link) && steps++ <= robot.links.size()) link = to_index(above[link]->parent);
    for (std::size_t at = k; !goes_on(link) && goes_on(at); at = to_index(above[at]->parent))
      reaches_root[at] = true;
    if (goes_on(link))
      throw InputError({above[k]->where, above[k]->element(),
                        "the joints form a ring that is not connected to the root",
                        robot.links[k].name, "a tree from one root link; close rings with <loop>"});
  }
  return root;
}

void check_mimics(RobotDescription* robot) {
  std::map<std::string, const JointDescription*> targets;
  std::vector<std::string> names;
  for (const JointDescription& joint : robot->joints) {
    if (joint.is_loop || joint.has_pose()) continue;
    targets[joint.name] = &joint;
    names.push_back(joint.name);
  }
  for (JointDescription& joint : robot->joints) {
    const std::optional<InputError> fault = mimic_fault(joint, targets, names);
    if (!fault) continue;
    if (joint.mimic->where.file != robot->file) throw *fault;
    InputFault warned = fault->fault();
    warned.message +=
        "; the element is ignored and the joint moves freely. Name the joint that it follows, or "
        "remove the element";
    robot->warnings.push_back(warn("mimic_ignored", warned));
    joint.mimic.reset();
  }
}

void check_friction(const RobotDescription& robot) {
  const auto is_body = [&](int link) {
    return link == robot.root || robot.links[to_index(link)].inertial.has_value();
  };
  for (const JointDescription& joint : robot.joints) {
    if (!joint.friction) continue;
    // Of a chain across links without mass, only the whole has a kind; but nothing slips in a fixed
    // joint of it.
    const bool is_whole =
        joint.is_loop || joint.is_fixed() || (is_body(joint.parent) && is_body(joint.child));
    if (is_whole)
      check_friction_geometry(*joint.friction, kind_of(joint),
                              joint.element() + " <codesign:friction>");
  }
}

}  // namespace codesign
