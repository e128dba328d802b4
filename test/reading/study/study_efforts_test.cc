// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/posture_grid.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

void expect_bad_efforts(const std::string& efforts, const std::string& element,
                        const std::string& message) {
  expect_fault("duration: 1\nefforts: " + efforts + "\n", element, message, 2);
}

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

TEST(StudyEfforts, RefusesWhatIsNoGrid) {
  expect_bad_efforts("{}", "efforts.grid", "required key is missing");
  expect_bad_efforts("{grid: {}}", "efforts.grid", "no joint has a position");
  expect_bad_efforts("{grid: {crank_joint: []}}", "efforts.grid.crank_joint", "found 0 positions");
  expect_bad_efforts("{grid: {crank_joint: 1.0}}", "efforts.grid.crank_joint", "list");
  expect_bad_efforts("{grid: {crank_jont: [0]}}", "efforts.grid.crank_jont",
                     "did you mean \"crank_joint\"?");
  expect_bad_efforts("{grid: {ball_joint: [0]}}", "efforts.grid.ball_joint", "coordinate");
  expect_bad_efforts("{grid: {crank_joint: {from: 0, to: 1, count: 1}}}",
                     "efforts.grid.crank_joint.count", "count out of range");
  expect_bad_efforts("{grid: {crank_joint: {from: 0, to: 1}}}", "efforts.grid.crank_joint.count",
                     "required key is missing");
  expect_bad_efforts(
      "{grid: {crank_joint: {from: 0, to: 1, count: 2000}, slider_joint: {from: 0, to: 1, count: "
      "2000}}}",
      "efforts.grid", "more than a million postures");
}

}  // namespace
}  // namespace codesign
