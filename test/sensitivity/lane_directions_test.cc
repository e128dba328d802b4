// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <array>
#include <cstdint>

#include "integration/servo.h"
#include "sensitivity/lane_directions.h"

namespace codesign {
namespace {

TEST(LaneDirections, AColumnIsOneComponentsDerivatives) {
  Directions<4> x(3);
  EXPECT_TRUE(x.isZero(0.0));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(x.data()) % 64, 0U);
  for (int k = 0; k < 12; ++k) x.data()[k] = k;
  x.vector(1) += Lanes<4>::Vector{10.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(x(0, 1), 14.0);
  EXPECT_EQ(x.vector(2)[3], 11.0);
}

TEST(LaneDirections, CopiesHaveMemoryOfTheirOwn) {
  Directions<8> x(2);
  x.setConstant(3.0);
  Directions<8> y = x, z;
  x.setZero();
  EXPECT_EQ(y(7, 1), 3.0);
  z = y;
  EXPECT_EQ(z.cols(), 2);
  EXPECT_NE(z.data(), y.data());
  EXPECT_EQ(z(0, 0), 3.0);
}

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
  for (int k = 0; k < count; ++k)
    parameters += (k ? ", p" : "p") + std::to_string(k) + ": {initial: " + std::to_string(k) + "}";
  const auto system =
      compile(pendulum(), "duration: 1.0\nparameters: {" + parameters +
                              "}\nobjective: {integral: [{signal: hinge/velocity}]}\n");
  LaneGroups<Probe> groups(*system, 7);
  std::vector<std::array<int, 3>> found;
  groups.for_each([&](auto* group) {
    EXPECT_EQ(group->tag, 7);
    found.push_back(
        {std::remove_pointer_t<decltype(group)>::kWidth, group->range.first, group->range.count});
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
      found.push_back(
          {std::remove_pointer_t<decltype(group)>::kWidth, group->range.first, group->range.count});
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
    for (int lane = 0; lane < 4; ++lane)
      EXPECT_EQ(seeded[p].v[lane], p == static_cast<std::size_t>(lane) + 1 && lane < 2 ? 1.0 : 0.0);
  }
}

TEST(LaneState, EachPartTakesItsValuesAndDirections) {
  Layout layout;
  layout.n = 7;
  layout.m = 3;
  layout.states = 2;
  const IncrementLayout at(layout);
  State<double> values;
  values.resize(layout);
  values.t = 0.5;
  values.q.setConstant(1.0);
  values.s.setConstant(2.0);
  values.v.setConstant(3.0);
  values.z.setConstant(4.0);
  Directions<4> directions(at.size());
  for (int k = 0; k < at.size(); ++k) directions.col(k) << k, 10.0 * k, 100.0 * k, -k;
  State<Lanes<4>> state;
  state.resize(layout);
  load_lanes(at, values, directions, &state);
  EXPECT_EQ(state.t, 0.5);
  const auto expect = [](const VectorX<Lanes<4>>& part, double value, int first) {
    for (Eigen::Index k = 0; k < part.size(); ++k) {
      EXPECT_EQ(part[k].a, value);
      EXPECT_EQ(part[k].v[1], 10.0 * static_cast<double>(first + k));
      EXPECT_EQ(part[k].v[3], -static_cast<double>(first + k));
    }
  };
  expect(state.q, 1.0, at.x());
  expect(state.s, 2.0, at.s());
  expect(state.v, 3.0, at.v());
  expect(state.z, 4.0, at.z());
}

}  // namespace

}  // namespace codesign
