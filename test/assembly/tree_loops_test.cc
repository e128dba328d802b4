// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/tree_loops.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(TreeLoops, KnowWhatIsGivenAndWhatIsDropped) {
  ReactionSharing sharing;
  sharing.compliance = 1e-9;
  sharing.pairs = {2};
  sharing.dropped = {{2, -1, 1}};
  LoopsToClose c(triangle(), "{right_hinge: {position: 0.5}}", sharing);
  ASSERT_EQ(c.loops.jacobian.rows(), 5);
  EXPECT_EQ(c.loops.drops, (std::vector<bool>{false, true, false, false, false}));
  EXPECT_EQ(c.loops.given.position, (std::vector<bool>{false, true}));
}

}  // namespace
}  // namespace codesign
