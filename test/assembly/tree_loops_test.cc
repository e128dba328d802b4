// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/tree_loops.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(TreeLoops, KnowWhatIsGivenAndWhatIsDropped) {
  LoopsToClose c(triangle(), "{right_hinge: {position: 0.5}}", without_row(1));
  ASSERT_EQ(c.loops.jacobian.rows(), 5);
  EXPECT_EQ(c.loops.drops, (std::vector<bool>{false, true, false, false, false}));
  EXPECT_EQ(c.loops.given.position, (std::vector<bool>{false, true}));
}

}  // namespace
}  // namespace codesign
