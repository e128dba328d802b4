// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/driven_tree.h"

#include <algorithm>
#include "mechanism/topology.h"

namespace codesign {
namespace {

class TreeBuilder {
 public:
  TreeBuilder(const Topology& topology, const SourceLocation& where, const std::string& element)
      : topology_(topology), where_(where), element_(element), carrier_(topology.bodies.size(), -1) {
    for (std::size_t k = 0; k < topology.pairs.size(); ++k) {
      if (topology.pairs[k].is_loop) continue;
      carrier_[static_cast<std::size_t>(child(topology.pairs[k]))] = static_cast<int>(k);
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

  const Pair& pair(int index) const { return topology_.pairs[static_cast<std::size_t>(index)]; }

  [[noreturn]] void fail(const std::string& message, const std::string& value, const std::string& allowed) const {
    throw InputError({where_, element_, message, value, allowed});
  }

  void require_simple(int index) const {
    const bool simple = pair(index).kind == PairKind::kRevolute || pair(index).kind == PairKind::kPrismatic;
    if (simple && !pair(index).is_loop && !upwards(pair(index))) return;
    fail("gravity compensation and computed torque cannot work through this joint", pair(index).name,
         "revolute, continuous and prismatic joints of the tree, with links that have an <inertial> on both sides");
  }

  int node_of(int body) const {
    for (std::size_t k = 0; k < tree_.nodes.size(); ++k)
      if (tree_.nodes[k].body == body) return static_cast<int>(k);
    return -1;
  }

  void add_node(int index, bool moved) {
    const Pair& p = pair(index);
    tree_.nodes.push_back({child(p), node_of(parent(p)), index, p.kind == PairKind::kPrismatic, moved, -1});
  }

  /// Adds the bodies that carry `body`, from the ground on, and `body` itself.
  void add_path(int body) {
    if (body < 0) return;
    const int above = carrier_[static_cast<std::size_t>(body)];
    if (above < 0)
      fail("a body that carries the driven joint is connected by a loop only, not by a joint of the tree",
           topology_.bodies[static_cast<std::size_t>(body)].name, "");
    require_simple(above);
    add_path(pair(above).body_i);
    add_node(above, false);
  }

  void add_subtree(int index, bool accelerations) {
    if (accelerations) require_simple(index);
    add_node(index, true);
    const int body = child(pair(index));
    for (std::size_t k = 0; k < topology_.pairs.size(); ++k)
      if (!topology_.pairs[k].is_loop && parent(topology_.pairs[k]) == body) add_subtree(static_cast<int>(k), accelerations);
  }

  void refuse_ties() const {
    const auto moved = [this](int body) {
      const int node = body < 0 ? -1 : node_of(body);
      return node >= 0 && tree_.nodes[static_cast<std::size_t>(node)].moved;
    };
    for (const Pair& loop : topology_.pairs)
      if (loop.is_loop && moved(loop.body_i) != moved(loop.body_j))
        fail(
            "a loop connects bodies that the joint moves with bodies that it does not move, so that the tree alone does not determine its "
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

DrivenTree driven_tree(const Topology& topology, int pair, bool accelerations, const SourceLocation& where, const std::string& element) {
  return TreeBuilder(topology, where, element).build(pair, accelerations);
}

}  // namespace codesign
