// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "description/reference.h"

namespace codesign {
namespace {

BasisDescription basis(BasisShape shape, int count, double duration) {
  return {shape, duration, std::vector<Quantity>(static_cast<std::size_t>(count), Quantity(0.0))};
}

/// u(t) for given coefficients, or u'(t).
double value(const BasisDescription& b, const std::vector<double>& c, double t, bool rate = false) {
  const BasisWeights w = basis_weights(b, t);
  double sum = 0.0;
  for (int k = 0; k < w.count; ++k)
    sum += (rate ? w.rate : w.value)[static_cast<std::size_t>(k)] *
           c[static_cast<std::size_t>(w.first + k)];
  return sum;
}

TEST(Basis, LinearCoefficientsAreTheValuesAtEqualTimes) {
  const BasisDescription b = basis(BasisShape::kLinear, 5, 2.0);
  const std::vector<double> c{1.0, -2.0, 0.5, 4.0, 3.0};
  for (std::size_t k = 0; k < c.size(); ++k)
    EXPECT_NEAR(value(b, c, 0.5 * static_cast<double>(k)), c[k], 1e-14);
  EXPECT_NEAR(value(b, c, 0.25), -0.5, 1e-14);
  EXPECT_NEAR(value(b, c, 0.25, true), -6.0, 1e-13);
}

// The uniform cubic B-spline has the weights 1/6, 4/6, 1/6 at an inner knot that is at least 3
// spans away from the repeated end knots.
TEST(Basis, CubicWeightsFarFromTheEndsAreThoseOfTheUniformSpline) {
  const BasisDescription b = basis(BasisShape::kCubic, 11, 8.0);
  const BasisWeights w = basis_weights(b, 4.0);
  EXPECT_EQ(w.first, 4);
  EXPECT_NEAR(w.value[0], 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(w.value[1], 4.0 / 6.0, 1e-14);
  EXPECT_NEAR(w.value[2], 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(w.value[3], 0.0, 1e-14);
  EXPECT_NEAR(w.rate[0], -0.5, 1e-14);
  EXPECT_NEAR(w.rate[2], 0.5, 1e-14);
}

TEST(Basis, WeightsSumToOneAndRatesAreTheirDerivatives) {
  for (const BasisShape shape : {BasisShape::kLinear, BasisShape::kCubic}) {
    for (int count : {4, 5, 9}) {
      const BasisDescription b = basis(shape, count, 1.7);
      std::vector<double> c;
      for (int k = 0; k < count; ++k) c.push_back(std::sin(3.0 * k + 1.0));
      for (double t : {0.013, 0.4, 0.911, 1.4, 1.69}) {
        EXPECT_NEAR(value(b, std::vector<double>(c.size(), 1.0), t), 1.0, 1e-14);
        EXPECT_NEAR(value(b, c, t, true), (value(b, c, t + 1e-6) - value(b, c, t - 1e-6)) / 2e-6,
                    1e-7);
      }
      EXPECT_NEAR(value(b, c, 0.0), c.front(), 1e-14);
      EXPECT_NEAR(value(b, c, 1.7), c.back(), 1e-14);
      EXPECT_NEAR(value(b, c, 5.0), c.back(), 1e-14) << "held after the end";
      EXPECT_EQ(value(b, c, 5.0, true), 0.0);
    }
  }
}

TEST(Basis, NoCoefficientHasInfluenceOutsideItsSupport) {
  for (const BasisShape shape : {BasisShape::kLinear, BasisShape::kCubic}) {
    const BasisDescription b = basis(shape, 9, 2.0);
    for (int k = 0; k < 9; ++k) {
      const auto [from, to] = b.support(k);
      bool inside = false;
      for (double t = 0.003; t < 3.0; t += 0.01) {
        std::vector<double> unit(9, 0.0);
        unit[static_cast<std::size_t>(k)] = 1.0;
        const bool active = value(b, unit, t) != 0.0;
        EXPECT_TRUE(!active || (from <= t && t <= to)) << k << " at " << t;
        inside = inside || active;
      }
      EXPECT_TRUE(inside) << k;
      EXPECT_LE(std::min(to, 2.0) - from, (shape == BasisShape::kLinear ? 0.5 : 4.0 / 3.0) + 1e-12)
          << "local support";
    }
    EXPECT_TRUE(std::isinf(b.support(8)[1]));
  }
}

Quantity quantity(const std::string& text) {
  return {0.0,
          std::make_shared<const Expression>(text, std::vector<std::string>{"a", "b", "c", "d"})};
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
