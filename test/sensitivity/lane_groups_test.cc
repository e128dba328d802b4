// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/lane_groups.h"

#include <gtest/gtest.h>

#include <array>

#include "integration/servo.h"

namespace codesign {
namespace {

template <int N>
struct Probe {
  Probe(const CompiledSystem&, LaneRange<N> lanes, int tag_given) : range(lanes), tag(tag_given) {}
  static constexpr int kWidth = N;
  LaneRange<N> range;
  int tag;
};

/// (width, first, count) of each group for a number of tuned parameters.
std::vector<std::array<int, 3>> groups_of(int count) {
  std::string parameters;
  for (int k = 0; k < count; ++k) parameters += (k ? ", p" : "p") + std::to_string(k) + ": {initial: " + std::to_string(k) + "}";
  const auto system =
      compile(pendulum(), "duration: 1.0\nparameters: {" + parameters + "}\nobjective: {integral: [{signal: hinge/velocity}]}\n");
  LaneGroups<Probe> groups(*system, 7);
  std::vector<std::array<int, 3>> found;
  groups.for_each([&](auto* group) {
    EXPECT_EQ(group->tag, 7);
    found.push_back({std::remove_pointer_t<decltype(group)>::kWidth, group->range.first, group->range.count});
  });
  return found;
}

TEST(LaneGroups, CoverEveryParameterOnce) {
  using Groups = std::vector<std::array<int, 3>>;
  EXPECT_EQ(groups_of(0), Groups());
  EXPECT_EQ(groups_of(1), (Groups{{4, 0, 1}}));
  EXPECT_EQ(groups_of(4), (Groups{{4, 0, 4}}));
  EXPECT_EQ(groups_of(5), (Groups{{8, 0, 5}}));
  EXPECT_EQ(groups_of(12), (Groups{{8, 0, 8}, {4, 8, 4}}));
  EXPECT_EQ(groups_of(13), (Groups{{8, 0, 8}, {8, 8, 5}}));
}

TEST(LaneGroups, KeepALaneWhereAskedTo) {
  const auto system = servo("{}");
  const auto groups_of_lanes = [&](int lanes) {
    LaneGroups<Probe> groups(LaneCount{lanes, 1}, *system, 7);
    std::vector<std::array<int, 3>> found;
    groups.for_each([&](auto* group) {
      found.push_back({std::remove_pointer_t<decltype(group)>::kWidth, group->range.first, group->range.count});
    });
    return found;
  };
  using Groups = std::vector<std::array<int, 3>>;
  EXPECT_EQ(groups_of_lanes(3), (Groups{{4, 0, 3}}));
  EXPECT_EQ(groups_of_lanes(4), (Groups{{8, 0, 4}}));
  EXPECT_EQ(groups_of_lanes(8), (Groups{{8, 0, 7}, {4, 7, 1}}));
}

TEST(LaneGroups, SeedOneDirectionPerLane) {
  const auto system = servo("{}");
  const std::vector<Lanes<4>> seeded = LaneRange<4>{1, 2}.seed(*system, system->parameters());
  ASSERT_EQ(seeded.size(), 5U);
  for (std::size_t p = 0; p < 5; ++p) {
    EXPECT_EQ(seeded[p].a, system->parameters()[p]);
    for (int lane = 0; lane < 4; ++lane) EXPECT_EQ(seeded[p].v[lane], p == static_cast<std::size_t>(lane) + 1 && lane < 2 ? 1.0 : 0.0);
  }
}

}  // namespace
}  // namespace codesign
