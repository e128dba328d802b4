// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/forest.h"

#include <algorithm>

#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

/// Above this number of pairs of coordinates that move the same body (a chain of 24 hinges) chains
/// are cut, so that matrices stay sparse, and the number of coordinates between two cuts;
/// decision 82.
constexpr int kMostCoupled = 300, kLongestChain = 10;

/// Ball and floating joints have no scalar coordinates that hold in all positions; they keep the
/// Euler parameters of their body.
bool has_scalar_coordinates(const Pair& pair) {
  const auto reversed = [](const ChainElement& element) { return element.reversed; };
  return pair.kind->in_forest && !pair.is_loop && pair.body_j >= 0 &&
         std::none_of(pair.chain.begin(), pair.chain.end(), reversed);
}

/// The number of pairs of coordinates that move the same body: the nonzeros of half the mass matrix
/// in joint coordinates.
int coupled_coordinates(const Topology& topology, const Forest& forest) {
  std::vector<int> above(topology.bodies.size(), 0);  // coordinates on the way to each body
  int sum = 0;
  for (int body : forest.order) {
    const Pair& pair = topology.pairs[to_index(forest.pair_above[to_index(body)])];
    const int own = forest_coordinates(pair),
              carried = pair.body_i < 0 ? 0 : above[to_index(pair.body_i)];
    above[to_index(body)] = carried + own;
    sum += own * above[to_index(body)];
  }
  return sum;
}

}  // namespace

int forest_coordinates(const Pair& pair) {
  const auto count = static_cast<int>(pair.chain.size());
  return count == 1 ? pair.kind->freedoms.size() : count;
}

Forest tree_forest(const Topology& topology, const std::vector<bool>& cut) {
  Forest forest;
  forest.pair_above.assign(topology.bodies.size(), -1);
  forest.body_below.assign(topology.pairs.size(), -1);
  forest.has_several.assign(topology.pairs.size(), false);
  for (std::size_t p = 0; p < topology.pairs.size(); ++p) {
    const Pair& pair = topology.pairs[p];
    if (cut[p] || !has_scalar_coordinates(pair) || forest.pair_above[to_index(pair.body_j)] >= 0)
      continue;
    forest.pair_above[to_index(pair.body_j)] = static_cast<int>(p);
    forest.body_below[p] = pair.body_j;
    forest.has_several[p] = forest_coordinates(pair) != static_cast<int>(pair.chain.size());
  }
  // A body follows its parent; the tree has no cycles.
  std::vector<bool> placed(topology.bodies.size(), false);
  const auto place = [&](auto&& self, int body) -> void {
    if (body < 0 || placed[to_index(body)]) return;
    placed[to_index(body)] = true;
    if (forest.pair_above[to_index(body)] < 0) return;
    self(self, topology.pairs[to_index(forest.pair_above[to_index(body)])].body_i);
    forest.order.push_back(body);
  };
  for (std::size_t body = 0; body < topology.bodies.size(); ++body)
    place(place, static_cast<int>(body));
  return forest.empty() ? Forest() : forest;
}

void cut_long_chains(const Topology& topology, std::vector<bool>* cut) {
  const Forest forest = tree_forest(topology, *cut);
  if (coupled_coordinates(topology, forest) <= kMostCoupled) return;
  std::vector<int> above(topology.bodies.size(), 0);
  for (int body : forest.order) {
    const int pair = forest.pair_above[to_index(body)],
              parent = topology.pairs[to_index(pair)].body_i;
    const int sum = forest_coordinates(topology.pairs[to_index(pair)]) +
                    (parent < 0 ? 0 : above[to_index(parent)]);
    (*cut)[to_index(pair)] = sum > kLongestChain;
    above[to_index(body)] = sum > kLongestChain ? 0 : sum;
  }
}

}  // namespace codesign
