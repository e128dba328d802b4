// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/posture_grid.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(StudyEfforts, ReadsPositionsAndRanges) {
  const PostureGrid grid =
      read_text(
          "duration: 1\nefforts:\n  grid:\n    crank_joint: {from: -1, to: 2, count: 4}\n"
          "    slider_joint: [0.5]\n")
          .grid;
  ASSERT_EQ(grid.size(), 2U);
  EXPECT_EQ(grid[0].joint, "crank_joint");
  EXPECT_EQ(grid[0].positions, (std::vector<double>{-1.0, 0.0, 1.0, 2.0}));
  EXPECT_EQ(grid[0].where.line, 4);
  EXPECT_EQ(grid[1].positions, std::vector<double>{0.5});
  EXPECT_TRUE(read_text("duration: 1\n").grid.empty());
}

}  // namespace
}  // namespace codesign
