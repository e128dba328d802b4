// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/reaction_sharing.h"

#include "math/arrays.h"
#include "system/state.h"

namespace codesign {
// A body of the forest carries a loop that shares reactions: at most one for each set of loops. It
// may stand still, since a displacement of all of them together loads nothing. Only rows of loops
// and couplings can be dropped: the rows of the tree's joints are independent of each other.
SharingLayout::SharingLayout(const ReactionSharing& sharing, const Topology& topology,
                             const Layout& layout) {
  first = layout.n + layout.constraints();
  body_slot.assign(to_index(layout.bodies), -1);
  row_slot.assign(to_index(layout.constraints()), -1);
  miss_slot.assign(to_index(layout.constraints()), -1);
  if (!sharing.drops()) return;
  const auto touch = [&](const Pair& pair) {
    for (int body : {pair.body_i, pair.body_j})
      if (body >= 0 && layout.is_free(body)) body_slot[to_index(body)] = 0;
  };
  const auto take_row = [this](int row, bool can_be_dropped) {
    row_slot[to_index(row)] = rows++;
    if (can_be_dropped) miss_slot[to_index(row)] = misses++;
  };
  for (int k : sharing.pairs) {
    touch(topology.pairs[to_index(k)]);
    for (int row = layout.pair_row[to_index(k)]; row < layout.pair_end(k); ++row)
      take_row(row, topology.pairs[to_index(k)].is_loop);
  }
  for (int k : sharing.couplings) {
    for (const CouplingTerm& term : topology.couplings[to_index(k)].terms)
      touch(topology.pairs[to_index(term.pair)]);
    take_row(layout.coupling_row(k), true);
  }
  for (int body = 0; body < layout.bodies; ++body) {
    if (body_slot[to_index(body)] < 0) continue;
    body_slot[to_index(body)] = static_cast<int>(bodies.size());
    bodies.push_back(body);
    take_row(layout.norm_row(body), false);
  }
}

}  // namespace codesign
