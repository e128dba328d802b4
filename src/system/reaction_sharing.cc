// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/reaction_sharing.h"

namespace codesign {
namespace {

std::size_t at(int k) { return static_cast<std::size_t>(k); }

}  // namespace

// Only rows of loops and couplings can be dropped: the rows of the tree's joints are independent of each other.
SharingLayout::SharingLayout(const ReactionSharing& sharing, const Topology& topology, const Layout& layout) {
  first = layout.n + layout.constraints();
  body_slot.assign(at(layout.bodies), -1);
  row_slot.assign(at(layout.constraints()), -1);
  miss_slot.assign(at(layout.constraints()), -1);
  if (!sharing.drops()) return;
  const auto touch = [this](const Pair& pair) {
    for (int body : {pair.body_i, pair.body_j})
      if (body >= 0) body_slot[at(body)] = 0;
  };
  const auto take_row = [this](int row, bool can_be_dropped) {
    row_slot[at(row)] = rows++;
    if (can_be_dropped) miss_slot[at(row)] = misses++;
  };
  for (int k : sharing.pairs) {
    touch(topology.pairs[at(k)]);
    for (int row = layout.pair_row[at(k)]; row < layout.pair_end(k); ++row) take_row(row, topology.pairs[at(k)].is_loop);
  }
  for (int k : sharing.couplings) {
    for (const CouplingTerm& term : topology.couplings[at(k)].terms) touch(topology.pairs[at(term.pair)]);
    take_row(layout.coupling_row(k), true);
  }
  for (int body = 0; body < layout.bodies; ++body) {
    if (body_slot[at(body)] < 0) continue;
    body_slot[at(body)] = static_cast<int>(bodies.size());
    bodies.push_back(body);
    take_row(layout.norm_row(body), false);
  }
}

}  // namespace codesign
