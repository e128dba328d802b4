// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/dependencies.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Quantity quantity(const std::string& text) {
  return {0.0, std::make_shared<const Expression>(text, std::vector<std::string>{"a", "b", "c", "d"})};
}

TEST(Dependencies, OfEachKindOfFunction) {
  ReferenceDescription constant(quantity("c"));
  EXPECT_EQ(dependencies(constant), (std::vector<int>{2}));
  ReferenceDescription sine = constant;
  sine.kind = ReferenceDescription::Kind::kSine;
  sine.sine.amplitude = quantity("b * a");
  sine.sine.phase = quantity("b");
  EXPECT_EQ(dependencies(sine), (std::vector<int>{0, 1}));
  sine.sine.frequency = quantity("d");
  EXPECT_EQ(dependencies(sine), (std::vector<int>{0, 1, 3}));
  ReferenceDescription waypoints;
  waypoints.kind = ReferenceDescription::Kind::kWaypoints;
  waypoints.waypoints.positions = {1.0, quantity("b")};
  waypoints.waypoints.velocities = {quantity("c"), 0.0};
  waypoints.waypoints.accelerations = {0.0, quantity("a")};
  EXPECT_EQ(dependencies(waypoints), (std::vector<int>{0, 1, 2}));
  ReferenceDescription sampled;
  sampled.kind = ReferenceDescription::Kind::kSampled;
  sampled.sampled.delay = quantity("d");
  EXPECT_EQ(dependencies(sampled), (std::vector<int>{3}));
  ReferenceDescription live;
  live.kind = ReferenceDescription::Kind::kLive;
  live.live.planned = std::make_shared<const ReferenceDescription>(waypoints);
  EXPECT_EQ(dependencies(live), (std::vector<int>{0, 1, 2}));
}

TEST(Dependencies, OfAShapedInputAreThoseOfItsCoefficients) {
  BasisDescription basis;
  basis.coefficients = {quantity("d"), 1.0, quantity("a + d")};
  EXPECT_EQ(dependencies(basis), (std::vector<int>{0, 3}));
}

}  // namespace
}  // namespace codesign
