// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/reaction_sharing.h"

#include <gtest/gtest.h>

#include <set>

#include "equations/compiled.h"
#include "integration/linkages.h"

namespace codesign {
namespace {

TEST(ReactionSharing, WithoutDroppedRowsThereAreNoFurtherUnknowns) {
  const Compiled c(four_bar(), let_go("{}", "left_hinge/velocity"), 1e-8);
  EXPECT_FALSE(c.system.sharing().drops());
  EXPECT_EQ(c.system.layout().sharing, 0);
  EXPECT_EQ(c.system.layout().constraints(), c.system.layout().m);
}

TEST(ReactionSharing, EachUnknownHasItsPlace) {
  ReactionSharing sharing(1e-8);
  const std::string hung =
      four_bar_with(bar("bob") + hinge("bob_hinge", "coupler", "bob", "0 0 -0.6"));
  const Compiled plain(hung, let_go("{}", "bob_hinge/velocity"), 1e-8);
  for (std::size_t k = 0; k < plain.system.topology().pairs.size(); ++k) {
    const Pair& pair = plain.system.topology().pairs[k];
    if (pair.name != "bob_hinge") sharing.pairs.push_back(static_cast<int>(k));
    if (pair.is_loop) sharing.dropped = {{static_cast<int>(k), -1, 1}};
  }
  const Compiled c(hung, let_go("{}", "bob_hinge/velocity"), sharing);
  const Layout& layout = c.system.layout();
  const SharingLayout& at = c.system.sharing_layout();
  EXPECT_EQ(layout.constraints(), plain.system.layout().m);
  EXPECT_EQ(at.bodies.size(), 3U) << "the bob takes no part";
  EXPECT_EQ(at.misses, 5) << "the rows of the loop";
  EXPECT_EQ(at.rows, 4 * 5 + 3);
  EXPECT_EQ(layout.sharing, 7 * 3 + at.rows + at.misses);
  std::set<int> columns;
  for (int body : at.bodies)
    for (int k = 0; k < 7; ++k) columns.insert(at.displacement(body) + k);
  for (int row = 0; row < layout.constraints(); ++row) {
    if (at.row_slot[static_cast<std::size_t>(row)] >= 0) columns.insert(at.load(row));
    if (at.has_miss(row)) columns.insert(at.miss(row));
  }
  EXPECT_EQ(static_cast<int>(columns.size()), layout.sharing);
  EXPECT_EQ(*columns.begin(), layout.n + layout.constraints());
  EXPECT_EQ(*columns.rbegin() + 1, layout.columns());
}

}  // namespace
}  // namespace codesign
