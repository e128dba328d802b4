// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/coupling.h"

#include <algorithm>

#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

CouplingTerm term_of(const RobotDescription& robot, const Topology& topology, int joint,
                     const Coupling& coupling) {
  CouplingTerm term;
  term.joint = joint;
  term.pair = topology.joint_pair[to_index(joint)];
  if (term.pair < 0)
    throw InputError(
        {coupling.where, coupling.element(),
         "the joint moves only a link without <inertial>, so nothing can be coupled to it",
         robot.joints[to_index(joint)].name, "joints that move a mass"});
  const std::vector<ChainElement>& chain = topology.pairs[to_index(term.pair)].chain;
  const auto found = std::find_if(chain.begin(), chain.end(),
                                  [joint](const ChainElement& e) { return e.joint == joint; });
  term.element = static_cast<int>(found - chain.begin());
  return term;
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
  if (robot.joints[to_index(leader)].is_fixed())
    return coupling;  // the fixed joint's coordinate is zero
  coupling.terms.push_back(term_of(robot, topology, leader, coupling));
  coupling.terms.back().sign = -1.0;
  coupling.terms.back().factor = joint.mimic->multiplier;
  return coupling;
}

/// The joints that are not fixed between a link and one of its ancestors, starting at the link.
/// Those that let another one play are no part of a coupling, whose row would hold them.
std::vector<int> moving_joints(const RobotDescription& robot, const Topology& topology, int link,
                               int ancestor, const Coupling& coupling) {
  std::vector<int> joints;
  for (int at = link; at != ancestor;) {
    const int k = topology.link_parent_joint[to_index(at)];
    const JointDescription& joint = robot.joints[to_index(k)];
    at = joint.parent;
    if (joint.is_fixed() || joint.is_play) continue;
    if (!joint.has_one_coordinate())
      throw InputError({coupling.where, coupling.element(),
                        "a joint between the coupled links has more than one coordinate",
                        joint.name, "revolute, continuous, prismatic and fixed joints"});
    joints.push_back(k);
  }
  return joints;
}

Coupling plus_coupling(const RobotDescription& robot, const Topology& topology,
                       const CouplingDescription& description) {
  Coupling coupling;
  coupling.name = description.name;
  coupling.where = description.where;
  const std::vector<int> above =
      links_above(robot, topology.link_parent_joint, description.predecessor);
  const std::vector<int> below =
      links_above(robot, topology.link_parent_joint, description.successor);
  const int ancestor = *std::find_first_of(below.begin(), below.end(), above.begin(), above.end());
  const std::vector<int> driven =
      moving_joints(robot, topology, description.successor, ancestor, coupling);
  if (driven.empty())
    throw InputError({coupling.where, coupling.element(),
                      "no joint moves the successor relative to the links' nearest common ancestor",
                      robot.links[to_index(description.successor)].name,
                      "swap predecessor and successor, and invert the ratio"});
  for (int joint : driven) coupling.terms.push_back(term_of(robot, topology, joint, coupling));
  for (int joint : moving_joints(robot, topology, description.predecessor, ancestor, coupling)) {
    coupling.terms.push_back(term_of(robot, topology, joint, coupling));
    coupling.terms.back().sign = -1.0;
    coupling.terms.back().factor = description.ratio;
  }
  return coupling;
}

class TreeBuilder {
 public:
  TreeBuilder(const Topology& topology, const SourceLocation& where, const std::string& element)
      : topology_(topology),
        where_(where),
        element_(element),
        carrier_(topology.bodies.size(), -1) {
    for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
      if (topology.pairs[k].is_loop) continue;
      carrier_[to_index(child(topology.pairs[k]))] = static_cast<int>(k);
    }
  }

  DrivenTree build(int pair, bool accelerations) {
    require_simple(pair);
    const int base = this->pair(pair).body_i;
    if (accelerations) {
      add_path(base);
    } else if (base >= 0) {
      tree_.nodes.push_back({base, -1, -1, false, false, -1});
    }
    tree_.driven = static_cast<int>(tree_.nodes.size());
    add_subtree(pair, accelerations);
    refuse_ties();
    return tree_;
  }

 private:
  // A pair whose chain runs from the child to the parent has the parent as body j.
  static bool upwards(const Pair& pair) { return pair.chain.front().reversed; }
  static int child(const Pair& pair) { return upwards(pair) ? pair.body_i : pair.body_j; }
  static int parent(const Pair& pair) { return upwards(pair) ? pair.body_j : pair.body_i; }

  const Pair& pair(int index) const { return topology_.pairs[to_index(index)]; }

  [[noreturn]] void fail(const std::string& message, const std::string& value,
                         const std::string& allowed) const {
    throw InputError({where_, element_, message, value, allowed});
  }

  void require_simple(int index) const {
    const bool simple =
        pair(index).kind == PairKind::kRevolute || pair(index).kind == PairKind::kPrismatic;
    if (simple && !pair(index).is_loop && !upwards(pair(index))) return;
    fail("gravity compensation and computed torque cannot work through this joint",
         pair(index).name,
         "revolute, continuous and prismatic joints of the tree, with links that have an "
         "<inertial> on both sides");
  }

  int node_of(int body) const {
    for (std::size_t k = 0; k < tree_.nodes.size(); ++k)
      if (tree_.nodes[k].body == body) return static_cast<int>(k);
    return -1;
  }

  void add_node(int index, bool moved) {
    const Pair& p = pair(index);
    tree_.nodes.push_back(
        {child(p), node_of(parent(p)), index, p.kind == PairKind::kPrismatic, moved, -1});
  }

  /// Adds the bodies that carry `body`, from the ground on, and `body` itself.
  void add_path(int body) {
    if (body < 0) return;
    const int above = carrier_[to_index(body)];
    if (above < 0)
      fail(
          "a body that carries the driven joint is connected by a loop only, not by a joint of the "
          "tree",
          topology_.bodies[to_index(body)].name,
          "bodies with a joint of the tree; make the loop of this body a joint, and another joint "
          "of the ring a loop");
    require_simple(above);
    add_path(pair(above).body_i);
    add_node(above, false);
  }

  void add_subtree(int index, bool accelerations) {
    if (accelerations) require_simple(index);
    add_node(index, true);
    const int body = child(pair(index));
    for (std::size_t k = 0; k < topology_.pairs.size(); ++k)
      if (!topology_.pairs[k].is_loop && parent(topology_.pairs[k]) == body)
        add_subtree(static_cast<int>(k), accelerations);
  }

  void refuse_ties() const {
    const auto moved = [this](int body) {
      const int node = body < 0 ? -1 : node_of(body);
      return node >= 0 && tree_.nodes[to_index(node)].moved;
    };
    for (const Pair& loop : topology_.pairs)
      if (loop.is_loop && moved(loop.body_i) != moved(loop.body_j))
        fail(
            "a loop connects bodies that the joint moves with bodies that it does not move, so "
            "that the tree alone does not determine its "
            "load",
            loop.name, "a joint that is not part of a loop");
  }

  const Topology& topology_;
  const SourceLocation& where_;
  const std::string& element_;
  std::vector<int> carrier_;  ///< per body: the pair of the tree that carries it, or -1
  DrivenTree tree_;
};

}  // namespace

std::string Coupling::element() const {
  if (motion >= 0) return "motion." + name;
  if (is_drive) return "<joint name=\"" + name + "\">";
  return is_mimic ? "<joint name=\"" + name + "\"> <mimic>" : "<coupling name=\"" + name + "\">";
}

std::vector<Coupling> derive_couplings(const RobotDescription& robot, const Topology& topology) {
  std::vector<Coupling> couplings;
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].mimic && topology.joint_pair[k] >= 0)
      couplings.push_back(mimic_coupling(robot, topology, static_cast<int>(k)));
  for (const CouplingDescription& description : robot.couplings)
    couplings.push_back(plus_coupling(robot, topology, description));
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

DrivenTree driven_tree(const Topology& topology, int pair, bool accelerations,
                       const SourceLocation& where, const std::string& element) {
  return TreeBuilder(topology, where, element).build(pair, accelerations);
}

}  // namespace codesign
