// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Functions whose rate is given, theory (C2b).
#include "control/reference.h"

#include <algorithm>
#include <stdexcept>

#include "control/reference_fixture.h"

namespace codesign {
namespace {

/// start + the integral of a rate.
Reference<double> integral_of(const ReferenceDescription& rate, double start) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kIntegral;
  description.integral = {std::make_shared<const ReferenceDescription>(rate), start};
  return Reference<double>(description, {});
}

TEST(Reference, AnIntegralIsExactForEveryRate) {
  const Reference<double> constant = integral_of(-10.0, 0.3);
  EXPECT_NEAR(constant.at(2.0).value, -19.7, 1e-14);
  EXPECT_EQ(constant.at(2.0).rate, -10.0);

  ReferenceDescription sine;
  sine.kind = ReferenceDescription::Kind::kSine;
  sine.sine = {2.0, 0.4, 0.5, 0.25, false};
  ReferenceDescription points;
  points.kind = ReferenceDescription::Kind::kWaypoints;
  points.waypoints.times = {0.4, 1.0, 1.7};
  points.waypoints.positions = {1.0, -2.0, 0.5};
  for (const ReferenceDescription& rate : {sine, points}) {
    const Reference<double> integral = integral_of(rate, 0.3);
    EXPECT_NEAR(integral.at(0.0).value, 0.3, 1e-15);
    for (double t : {0.2, 0.7, 1.3, 2.5}) {
      const double difference =
          ridders_derivative([&](double x) { return integral.at(x).value; }, t, 1e-2).value;
      EXPECT_NEAR(difference, Reference<double>(rate, {}).at(t).value, 1e-9) << t;
    }
  }
}

// The kink at A moves with the parameter, and the panels with the kink.
TEST(Reference, AnExpressionIsIntegratedToRounding) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kIntegral;
  description.integral.rate = std::make_shared<const ReferenceDescription>(
      expression_of("A*cos(40*t) + max(t - A, 0)", {"A", "t"}));
  description.integral.start = 0.3;
  description.integral.duration = 2.0;
  const double A = 0.7;
  const auto value = [](double a, double t) {
    return 0.3 + a * std::sin(40.0 * t) / 40.0 + (t > a ? 0.5 * (t - a) * (t - a) : 0.0);
  };
  const auto slope = [](double a, double t) {
    return std::sin(40.0 * t) / 40.0 - (t > a ? t - a : 0.0);
  };
  const Reference<double> reference(description, {A});
  using L = Lanes<4>;
  const Reference<L> lanes(description, {L(A, L::Vector{1.0, 0.0, 0.0, 0.0})});
  for (const double t : {-0.4, 0.0, 0.35, 0.7, 1.234, 2.0, 3.7}) {
    EXPECT_NEAR(reference.at(t).value, value(A, t), 2e-14 * (1.0 + value(A, t))) << t;
    EXPECT_EQ(reference.at(t).rate, A * std::cos(40.0 * t) + std::max(t - A, 0.0));
    EXPECT_NEAR(lanes.at(t).value.v[0], slope(A, t), 2e-12) << t;
  }
}

TEST(Reference, AnIntegralOfAnIntegralIsRefused) {
  ReferenceDescription rate;
  rate.kind = ReferenceDescription::Kind::kIntegral;
  rate.integral.rate = std::make_shared<const ReferenceDescription>(1.0);
  EXPECT_THROW(integral_of(rate, 0.0), std::logic_error);
}

}  // namespace
}  // namespace codesign
