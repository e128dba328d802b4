// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/topology.h"

#include <algorithm>
#include <map>

#include "math/arrays.h"
#include "mechanism/fold_chain.h"
#include "mechanism/loop_plane.h"
#include "mechanism/pair_geometry.h"
#include "mechanism/rigid_groups.h"

namespace codesign {
namespace {

/// The graph of the mechanism: its vertices are groups of rigidly joined links, its edges joints,
/// loops, or chains of them.
struct Edge {
  int from = -1, to = -1;  // groups
  std::vector<ChainElement> chain;
  std::vector<int> inside;  // massless groups between the elements of the chain
};

bool has_mass(const LinkDescription& link) { return link.inertial.has_value(); }

class TopologyBuilder {
 public:
  explicit TopologyBuilder(const RobotDescription& robot) : robot_(robot) {}

  Topology build() {
    find_groups();
    find_masses();
    find_coupled();
    collect_edges();
    drop_massless_ends();
    contract_massless_chains();
    unfold_chains();
    number_bodies();
    make_pairs();
    find_planes();
    return std::move(topology_);
  }

 private:
  static std::size_t index(int k) { return to_index(k); }
  bool massless(int base) const { return !is_body_[index(base)]; }

  void find_groups() {
    RigidGroups groups(robot_);
    topology_.link_parent_joint = std::move(groups.link_parent_joint);
    topology_.link_base = std::move(groups.link_base);
    topology_.joint_pair.assign(robot_.joints.size(), -1);
  }

  void find_masses() {
    is_body_.assign(robot_.links.size(), false);
    is_body_[index(robot_.root)] = true;
    for (std::size_t link = 0; link < robot_.links.size(); ++link)
      if (has_mass(robot_.links[link]) || robot_.links[link].stays)
        is_body_[index(topology_.link_base[link])] = true;
  }

  // Bodies are numbered in the order of their base links in the file, which is the order of q.
  void number_bodies() {
    std::map<int, std::vector<int>> groups;
    for (std::size_t link = 0; link < robot_.links.size(); ++link)
      groups[topology_.link_base[link]].push_back(static_cast<int>(link));
    topology_.link_body.assign(robot_.links.size(), Topology::kMassless);
    for (auto& [base, links] : groups) {
      int body = Topology::kMassless;
      if (base == robot_.root) {
        body = Topology::kGround;
      } else if (!massless(base)) {
        body = static_cast<int>(topology_.bodies.size());
        std::stable_partition(links.begin(), links.end(),
                              [base = base](int link) { return link == base; });
        topology_.bodies.push_back({robot_.links[index(base)].name, base, links});
      }
      for (int link : links) topology_.link_body[index(link)] = body;
    }
  }

  void collect_edges() {
    for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
      const JointDescription& joint = robot_.joints[k];
      if (joint.is_fixed() && !joint.is_loop) continue;
      edges_.push_back(single_edge(static_cast<int>(k)));
      if (edges_.back().from == edges_.back().to)
        throw InputError({joint.where, joint.element(), "both ends lie on the same rigid body",
                          robot_.links[index(joint.parent)].name,
                          "two links that no chain of fixed joints connects"});
    }
  }

  Edge single_edge(int joint) const {
    const JointDescription& description = robot_.joints[index(joint)];
    return {topology_.link_base[index(description.parent)],
            topology_.link_base[index(description.child)],
            {{joint, false}},
            {}};
  }

  std::vector<std::size_t> edges_at(int group) const {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < edges_.size(); ++k)
      if (edges_[k].from == group || edges_[k].to == group) result.push_back(k);
    return result;
  }

  // A massless link at the end of a chain, such as a sensor frame, has no dynamics: its joint keeps
  // its position.
  void drop_massless_ends() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t link = 0; link < robot_.links.size(); ++link) {
        const int group = static_cast<int>(link);
        if (topology_.link_base[link] != group || !massless(group)) continue;
        const auto edges = edges_at(group);
        if (edges.size() != 1 || carries_load(edges_[edges[0]].chain[0].joint)) continue;
        edges_.erase(edges_.begin() + to_signed(edges[0]));
        changed = true;
      }
    }
  }

  // Whether the joint of a massless end link must be kept: it has a rotor, other joints mimic it,
  // or a coupling counts it.
  bool carries_load(int joint) const {
    const JointDescription& description = robot_.joints[index(joint)];
    if (description.actuator) return true;
    for (const Edge& edge : edges_) {
      const std::optional<MimicDescription>& mimic =
          robot_.joints[index(edge.chain[0].joint)].mimic;
      if (mimic && mimic->joint == description.name) return true;
    }
    return in_coupling_[index(joint)];
  }

  void find_coupled() {
    in_coupling_.assign(robot_.joints.size(), false);
    for (const CouplingDescription& coupling : robot_.couplings)
      for (int joint : joints_between(robot_, topology_.link_parent_joint, coupling.predecessor,
                                      coupling.successor))
        if (!robot_.joints[index(joint)].is_play) in_coupling_[index(joint)] = true;
  }

  // A massless group between two joints is folded. Any other massless group, with three joints or
  // more or with a load, becomes a body without mass.
  void contract_massless_chains() {
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      const int group = static_cast<int>(link);
      if (topology_.link_base[link] != group || !massless(group)) continue;
      const auto edges = edges_at(group);
      if (edges.empty()) continue;
      if (edges.size() == 2) {
        join(group, edges[0], edges[1]);
      } else {
        is_body_[link] = true;
      }
    }
  }

  // The massless links of a chain that is not equivalent to one joint, or that returns to the body
  // where it starts, become bodies without mass.
  void unfold_chains() {
    for (std::size_t k = 0; k < edges_.size();) {
      const Edge edge = edges_[k];
      if (edge.chain.size() == 1 ||
          (edge.from != edge.to && folds(robot_, topology_, edge.chain))) {
        ++k;
        continue;
      }
      edges_.erase(edges_.begin() + to_signed(k));
      if (edge.from == edge.to) continue;
      for (int group : edge.inside) is_body_[index(group)] = true;
      for (const ChainElement& element : edge.chain) edges_.push_back(single_edge(element.joint));
    }
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const Edge& a, const Edge& b) { return first_joint(a) < first_joint(b); });
  }

  static int first_joint(const Edge& edge) {
    const auto by_number = [](const ChainElement& a, const ChainElement& b) {
      return a.joint < b.joint;
    };
    return std::min_element(edge.chain.begin(), edge.chain.end(), by_number)->joint;
  }

  // Replaces two edges that meet in a massless group by one edge through it.
  void join(int group, std::size_t first, std::size_t second) {
    Edge a = edges_[first], b = edges_[second];
    if (a.to != group && b.to == group) std::swap(a, b);
    if (a.to != group) reverse(&a);
    if (b.from != group) reverse(&b);
    Edge joined{a.from, b.to, a.chain, a.inside};
    joined.inside.push_back(group);
    joined.inside.insert(joined.inside.end(), b.inside.begin(), b.inside.end());
    joined.chain.insert(joined.chain.end(), b.chain.begin(), b.chain.end());
    edges_[std::min(first, second)] = joined;
    edges_.erase(edges_.begin() + to_signed(std::max(first, second)));
  }

  static void reverse(Edge* edge) {
    std::swap(edge->from, edge->to);
    std::reverse(edge->chain.begin(), edge->chain.end());
    for (ChainElement& element : edge->chain) element.reversed = !element.reversed;
  }

  void make_pairs() {
    for (const Edge& edge : edges_) {
      Pair pair;
      pair.chain = edge.chain;
      pair.body_i = topology_.link_body[index(edge.from)];
      pair.body_j = topology_.link_body[index(edge.to)];
      pair.kind = fold_chain(robot_, topology_, pair.chain);
      for (const ChainElement& element : edge.chain) {
        const JointDescription& joint = robot_.joints[index(element.joint)];
        topology_.joint_pair[index(element.joint)] = static_cast<int>(topology_.pairs.size());
        pair.name += (pair.name.empty() ? "" : "+") + joint.name;
        pair.is_loop = pair.is_loop || joint.is_loop;
        take_friction(element.joint, &pair);
      }
      if (pair.friction_joint >= 0) check_friction(pair);
      topology_.pairs.push_back(pair);
    }
  }

  // The joints around the loops that are held in the plane of their motion, which must be planar.
  void find_planes() {
    for (Pair& pair : topology_.pairs) {
      for (const ChainElement& element : pair.chain)
        if (const JointDescription& loop = robot_.joints[index(element.joint)];
            loop.in_plane && pair.chain.size() > 1)
          throw InputError({loop.where, loop.element(),
                            "a loop that is folded with joints across links without <inertial> "
                            "cannot be held in a plane only",
                            pair.name,
                            "give the links an <inertial>, or leave out "
                            "codesign:out_of_plane"});
      if (!is_in_plane(robot_, pair)) continue;
      pair.around = joints_around(robot_, topology_.link_parent_joint, pair.chain[0].joint);
      require_planar(robot_, topology_, pair);
    }
  }

  void take_friction(int joint, Pair* pair) const {
    const JointDescription& description = robot_.joints[index(joint)];
    if (!description.friction) return;
    if (pair->friction_joint >= 0)
      throw InputError({description.friction->where, description.element(),
                        "a second <codesign:friction> on one folded joint", pair->name,
                        "one for the whole chain of massless links"});
    pair->friction_joint = joint;
    pair->friction_is_direct = description.friction->is_direct;
  }

  // The URDF reader checks ordinary joints only, not those folded from a chain.
  void check_friction(const Pair& pair) const {
    const JointDescription& joint = robot_.joints[index(pair.friction_joint)];
    check_friction_geometry(*joint.friction, pair.kind, joint.element() + " <codesign:friction>");
  }

  const RobotDescription& robot_;
  Topology topology_;
  std::vector<bool>
      is_body_;  // per base link of a group: it has mass, is the ground, or cannot be folded
  std::vector<bool> in_coupling_;  // per joint: it is part of a coupling
  std::vector<Edge> edges_;
};

}  // namespace

Topology derive_topology(const RobotDescription& robot) {
  Topology topology = TopologyBuilder(robot).build();
  topology.couplings = derive_couplings(robot, topology);
  return topology;
}

std::vector<int> links_above(const RobotDescription& robot,
                             const std::vector<int>& link_parent_joint, int link) {
  std::vector<int> links = {link};
  for (int joint; (joint = link_parent_joint[to_index(links.back())]) >= 0;)
    links.push_back(robot.joints[to_index(joint)].parent);
  return links;
}

std::vector<int> joints_between(const RobotDescription& robot,
                                const std::vector<int>& link_parent_joint, int predecessor,
                                int successor) {
  const std::vector<int> above = links_above(robot, link_parent_joint, predecessor);
  const std::vector<int> below = links_above(robot, link_parent_joint, successor);
  const int ancestor = *std::find_first_of(below.begin(), below.end(), above.begin(), above.end());
  std::vector<int> joints;
  for (int end : {predecessor, successor}) {
    for (int link = end; link != ancestor;) {
      const int joint = link_parent_joint[to_index(link)];
      if (!robot.joints[to_index(joint)].is_fixed()) joints.push_back(joint);
      link = robot.joints[to_index(joint)].parent;
    }
  }
  return joints;
}

}  // namespace codesign
