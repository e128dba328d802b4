// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/lane_plan.h"

#include "sensitivity/gradient_cases.h"

namespace codesign {
namespace {

TEST(LanePlan, ParametersWithoutACommonRowShareALane) {
  const LanePlan plan = plan_lanes({{0, 1}, {1, 2}, {3}, {0, 2, 3}, {}});
  EXPECT_EQ(plan.lanes, 3);
  EXPECT_EQ(plan.lane[3], 0);
  EXPECT_NE(plan.lane[0], plan.lane[1]);
  EXPECT_NE(plan.lane[0], plan.lane[3]);
  EXPECT_NE(plan.lane[1], plan.lane[3]);
  EXPECT_NE(plan.lane[2], plan.lane[3]);
}

TEST(LanePlan, OfAChainDoesNotGrowWithItsLength) {
  const auto lanes = [](int links) {
    const GeneratedCase chain = parametric_chain(links, 4 * links);
    return plan_lanes(*from_texts("chain", chain.urdf.text, chain.study.text).compile("rodas4", "auto")).lanes;
  };
  const int lanes_of_8 = lanes(8);
  EXPECT_LE(lanes_of_8, 12);
  EXPECT_EQ(lanes(16), lanes_of_8);
}

// The rows of a body depend on its mass; the rows of both bodies of a hinge depend on its radius.
TEST(LanePlan, RowsAreThoseOfTheBodiesTouched) {
  const GeneratedCase chain = parametric_chain(3, 12);
  const auto system = from_texts("chain", chain.urdf.text, chain.study.text).compile("rodas4", "auto");
  const LanePlan plan = plan_lanes(*system);
  const auto motion_rows = [&](std::size_t parameter) {
    std::set<int> bodies;
    for (int row : plan.rows[parameter])
      if (row < system->layout().n) bodies.insert(row / kBodySize);
    return bodies;
  };
  EXPECT_EQ(motion_rows(5), (std::set<int>{1}));      // mass_1
  EXPECT_EQ(motion_rows(6), (std::set<int>{0, 1}));   // radius_1
  EXPECT_EQ(motion_rows(11), (std::set<int>{1, 2}));  // friction_2
}

}  // namespace
}  // namespace codesign
