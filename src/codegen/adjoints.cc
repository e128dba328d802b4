// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/adjoints.h"

#include "codegen/partials.h"
#include "math/to_index.h"

namespace codesign {
namespace {

/// Per node, whether it is a target or computed from one.
std::vector<bool> nodes_after(const Recording& recording, const std::vector<bool>& is_target) {
  std::vector<bool> after = is_target;
  after.resize(to_index(recording.size()));
  for (int n = 0; n < recording.size(); ++n) {
    const Recording::Node& node = recording.node(n);
    if (after[to_index(n)] || node.operation == Operation::kLeaf || node.operation == Operation::kLiteral) continue;
    after[to_index(n)] = after[to_index(node.a)] || (node.b >= 0 && after[to_index(node.b)]);
  }
  return after;
}

}  // namespace

std::vector<Traced> derive_adjoints(Recording* recording, const std::vector<AdjointSeed>& seeds, const std::vector<bool>& is_target) {
  const std::vector<bool> matters = nodes_after(*recording, is_target);
  std::vector<Traced> adjoints(matters.size(), Traced(0.0));
  const auto add = [&](int n, const Traced& x) {
    if (matters[to_index(n)]) adjoints[to_index(n)] = folded(recording, adjoints[to_index(n)] + x);
  };
  for (const AdjointSeed& seed : seeds) add(seed.node, seed.weight);
  for (std::size_t n = matters.size(); n-- > 0;) {
    if ((n < is_target.size() && is_target[n]) || adjoints[n].is(0.0)) continue;
    for (const Partial& partial : partials_of(recording, static_cast<int>(n)))
      add(partial.node, product(recording, adjoints[n], folded(recording, partial.factor)));
    adjoints[n] = Traced(0.0);
  }
  adjoints.resize(is_target.size());
  return adjoints;
}

}  // namespace codesign
