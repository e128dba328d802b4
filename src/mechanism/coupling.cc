// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/coupling.h"

#include <algorithm>

#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

CouplingTerm term_of(const RobotDescription& robot, const Topology& topology, int joint, const Coupling& coupling) {
  CouplingTerm term;
  term.joint = joint;
  term.pair = topology.joint_pair[to_index(joint)];
  if (term.pair < 0)
    throw InputError({coupling.where, coupling.element(), "the joint moves only a link without <inertial>, so nothing can be coupled to it",
                      robot.joints[to_index(joint)].name, "joints that move a mass"});
  const std::vector<ChainElement>& chain = topology.pairs[to_index(term.pair)].chain;
  const auto found = std::find_if(chain.begin(), chain.end(), [joint](const ChainElement& e) { return e.joint == joint; });
  term.element = static_cast<int>(found - chain.begin());
  return term;
}

int joint_named(const RobotDescription& robot, const std::string& name) {
  const auto found = std::find_if(robot.joints.begin(), robot.joints.end(), [&name](const JointDescription& j) { return j.name == name; });
  return static_cast<int>(found - robot.joints.begin());
}

Coupling mimic_coupling(const RobotDescription& robot, const Topology& topology, int follower) {
  const JointDescription& joint = robot.joints[to_index(follower)];
  Coupling coupling;
  coupling.name = joint.name;
  coupling.is_mimic = true;
  coupling.where = joint.mimic->where;
  coupling.offset = joint.mimic->offset;
  coupling.terms.push_back(term_of(robot, topology, follower, coupling));
  const int leader = joint_named(robot, joint.mimic->joint);
  if (robot.joints[to_index(leader)].type == JointType::kFixed) return coupling;  // the fixed joint's coordinate is zero
  coupling.terms.push_back(term_of(robot, topology, leader, coupling));
  coupling.terms.back().sign = -1.0;
  coupling.terms.back().factor = joint.mimic->multiplier;
  return coupling;
}

/// The joints that are not fixed between a link and one of its ancestors, starting at the link.
std::vector<int> moving_joints(const RobotDescription& robot, const Topology& topology, int link, int ancestor, const Coupling& coupling) {
  std::vector<int> joints;
  for (int at = link; at != ancestor;) {
    const int k = topology.link_parent_joint[to_index(at)];
    const JointDescription& joint = robot.joints[to_index(k)];
    at = joint.parent;
    if (joint.type == JointType::kFixed) continue;
    if (!has_one_coordinate(joint.type))
      throw InputError({coupling.where, coupling.element(), "a joint between the coupled links has more than one coordinate", joint.name,
                        "revolute, continuous, prismatic and fixed joints"});
    joints.push_back(k);
  }
  return joints;
}

Coupling plus_coupling(const RobotDescription& robot, const Topology& topology, const CouplingDescription& description) {
  Coupling coupling;
  coupling.name = description.name;
  coupling.where = description.where;
  const std::vector<int> above = links_above(robot, topology.link_parent_joint, description.predecessor);
  const std::vector<int> below = links_above(robot, topology.link_parent_joint, description.successor);
  const int ancestor = *std::find_first_of(below.begin(), below.end(), above.begin(), above.end());
  const std::vector<int> driven = moving_joints(robot, topology, description.successor, ancestor, coupling);
  if (driven.empty())
    throw InputError({coupling.where, coupling.element(), "no joint moves the successor relative to the links' nearest common ancestor",
                      robot.links[to_index(description.successor)].name, "swap predecessor and successor, and invert the ratio"});
  for (int joint : driven) coupling.terms.push_back(term_of(robot, topology, joint, coupling));
  for (int joint : moving_joints(robot, topology, description.predecessor, ancestor, coupling)) {
    coupling.terms.push_back(term_of(robot, topology, joint, coupling));
    coupling.terms.back().sign = -1.0;
    coupling.terms.back().factor = description.ratio;
  }
  return coupling;
}

}  // namespace

std::string Coupling::element() const {
  if (is_drive) return "<joint name=\"" + name + "\">";
  return is_mimic ? "<joint name=\"" + name + "\"> <mimic>" : "<coupling name=\"" + name + "\">";
}

std::vector<Coupling> derive_couplings(const RobotDescription& robot, const Topology& topology) {
  std::vector<Coupling> couplings;
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].mimic && topology.joint_pair[k] >= 0) couplings.push_back(mimic_coupling(robot, topology, static_cast<int>(k)));
  for (const CouplingDescription& description : robot.couplings) couplings.push_back(plus_coupling(robot, topology, description));
  return couplings;
}

Coupling drive_of(const RobotDescription& robot, const Topology& topology, int joint) {
  Coupling coupling;
  coupling.name = robot.joints[to_index(joint)].name;
  coupling.is_drive = true;
  coupling.where = robot.joints[to_index(joint)].where;
  coupling.terms.push_back(term_of(robot, topology, joint, coupling));
  return coupling;
}

}  // namespace codesign
