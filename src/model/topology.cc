// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/topology.h"

#include <algorithm>
#include <map>

#include "fold_chain.h"
#include "mechanism_codesign/model/friction_geometry.h"

namespace codesign {
namespace {

/// A vertex is a rigid group of links; an edge is a joint or loop, or a chain of them.
struct Edge {
  int from = -1, to = -1;  // groups
  std::vector<ChainElement> chain;
};

bool has_mass(const LinkDescription& link) { return link.inertial.has_value(); }

std::string joint_element(const JointDescription& joint) {
  return (joint.is_loop ? "<loop name=\"" : "<joint name=\"") + joint.name + "\">";
}

/// The type of an ordinary joint with the same friction law. Joints without one are alike.
JointType equivalent_type(PairKind kind) {
  switch (kind) {
    case PairKind::kRevolute:
      return JointType::kRevolute;
    case PairKind::kPrismatic:
      return JointType::kPrismatic;
    case PairKind::kCylindrical:
      return JointType::kCylindrical;
    case PairKind::kSpherical:
      return JointType::kSpherical;
    case PairKind::kTable:
    case PairKind::kPlanar:
      return JointType::kPlanar;
    default:
      return JointType::kFloating;
  }
}

class TopologyBuilder {
 public:
  explicit TopologyBuilder(const RobotDescription& robot) : robot_(robot) {}

  Topology build() {
    find_groups();
    find_bodies();
    collect_edges();
    drop_massless_ends();
    contract_massless_chains();
    make_pairs();
    return std::move(topology_);
  }

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  bool massless(int base) const { return topology_.link_body[index(base)] == Topology::kMassless; }

  void find_groups() {
    const std::size_t links = robot_.links.size();
    topology_.link_parent_joint.assign(links, -1);
    topology_.link_base.assign(links, -1);
    topology_.joint_pair.assign(robot_.joints.size(), -1);
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
      if (!robot_.joints[k].is_loop) topology_.link_parent_joint[index(robot_.joints[k].child)] = static_cast<int>(k);
    for (std::size_t link = 0; link < links; ++link) topology_.link_base[link] = base_of(static_cast<int>(link));
  }

  int base_of(int link) const {
    for (;;) {
      const int joint = topology_.link_parent_joint[index(link)];
      if (joint < 0 || robot_.joints[index(joint)].type != JointType::kFixed) return link;
      link = robot_.joints[index(joint)].parent;
    }
  }

  // Bodies are numbered in the order of the file, so that q is laid out as its reader expects.
  void find_bodies() {
    std::map<int, std::vector<int>> groups;
    for (std::size_t link = 0; link < robot_.links.size(); ++link) groups[topology_.link_base[link]].push_back(static_cast<int>(link));
    topology_.link_body.assign(robot_.links.size(), Topology::kMassless);
    for (auto& [base, links] : groups) {
      const bool heavy = std::any_of(links.begin(), links.end(), [this](int link) { return has_mass(robot_.links[index(link)]); });
      int body = Topology::kMassless;
      if (base == robot_.root) {
        body = Topology::kGround;
      } else if (heavy) {
        body = static_cast<int>(topology_.bodies.size());
        std::stable_partition(links.begin(), links.end(), [base = base](int link) { return link == base; });
        topology_.bodies.push_back({robot_.links[index(base)].name, base, links});
      }
      for (int link : links) topology_.link_body[index(link)] = body;
    }
  }

  void collect_edges() {
    for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
      const JointDescription& joint = robot_.joints[k];
      if (joint.type == JointType::kFixed && !joint.is_loop) continue;
      const int from = topology_.link_base[index(joint.parent)], to = topology_.link_base[index(joint.child)];
      if (from == to)
        throw InputError(
            {joint.where, joint_element(joint), "both ends lie on the same rigid body", robot_.links[index(joint.parent)].name, ""});
      edges_.push_back({from, to, {{static_cast<int>(k), false}}});
    }
  }

  std::vector<std::size_t> edges_at(int group) const {
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < edges_.size(); ++k)
      if (edges_[k].from == group || edges_[k].to == group) result.push_back(k);
    return result;
  }

  // A massless link at the end of a chain (a sensor frame) carries no load: its joint stays where it starts.
  void drop_massless_ends() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t link = 0; link < robot_.links.size(); ++link) {
        const int group = static_cast<int>(link);
        if (topology_.link_base[link] != group || !massless(group)) continue;
        const auto edges = edges_at(group);
        if (edges.size() != 1) continue;
        edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(edges[0]));
        changed = true;
      }
    }
  }

  void contract_massless_chains() {
    for (std::size_t link = 0; link < robot_.links.size(); ++link) {
      const int group = static_cast<int>(link);
      if (topology_.link_base[link] != group || !massless(group)) continue;
      const auto edges = edges_at(group);
      if (edges.empty()) continue;
      if (edges.size() != 2) refuse_branching(group, edges.size());
      join(group, edges[0], edges[1]);
    }
  }

  [[noreturn]] void refuse_branching(int group, std::size_t count) const {
    const LinkDescription& link = robot_.links[index(group)];
    throw InputError({link.where, "<link name=\"" + link.name + "\">",
                      "a link without <inertial> between " + std::to_string(count) + " joints cannot be folded into one joint", "",
                      "give it an <inertial>"});
  }

  // The joined edge runs from the end of the one that arrives to the end of the one that leaves.
  void join(int group, std::size_t first, std::size_t second) {
    Edge a = edges_[first], b = edges_[second];
    if (a.to != group && b.to == group) std::swap(a, b);
    if (a.to != group) reverse(&a);
    if (b.from != group) reverse(&b);
    Edge joined{a.from, b.to, a.chain};
    joined.chain.insert(joined.chain.end(), b.chain.begin(), b.chain.end());
    edges_[std::min(first, second)] = joined;
    edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(std::max(first, second)));
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

  void take_friction(int joint, Pair* pair) const {
    const JointDescription& description = robot_.joints[index(joint)];
    if (!description.friction) return;
    if (pair->friction_joint >= 0)
      throw InputError({description.friction->where, joint_element(description), "a second <codesign:friction> on one folded joint",
                        pair->name, "one for the whole chain of massless links"});
    pair->friction_joint = joint;
  }

  // The reader has checked joints between links with mass, not those folded from a chain.
  void check_friction(const Pair& pair) const {
    const JointDescription& joint = robot_.joints[index(pair.friction_joint)];
    check_friction_geometry(*joint.friction, equivalent_type(pair.kind), joint_element(joint) + " <codesign:friction>");
  }

  const RobotDescription& robot_;
  Topology topology_;
  std::vector<Edge> edges_;
};

}  // namespace

Topology derive_topology(const RobotDescription& robot) {
  Topology topology = TopologyBuilder(robot).build();
  topology.couplings = derive_couplings(robot, topology);
  return topology;
}

}  // namespace codesign
