// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/ridders.h"

namespace codesign {
namespace {

Reference<double> through(const WaypointsDescription& points) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kWaypoints;
  description.waypoints = points;
  return Reference<double>(description, {});
}

/// Compares each derivative with differences of the one before it.
void expect_derivatives(const Reference<double>& reference, double t) {
  const auto difference = [t](const auto& f) { return ridders_derivative(f, t, 1e-2).value; };
  const ReferenceMotion<double> m = reference.at(t);
  EXPECT_NEAR(m.rate, difference([&](double x) { return reference.at(x).value; }), 1e-8 * (1.0 + std::abs(m.rate)));
  EXPECT_NEAR(m.acceleration, difference([&](double x) { return reference.at(x).rate; }), 1e-8 * (1.0 + std::abs(m.acceleration)));
  EXPECT_NEAR(m.jerk, difference([&](double x) { return reference.at(x).acceleration; }), 1e-8 * (1.0 + std::abs(m.jerk)));
}

TEST(Reference, AConstantStays) {
  const Reference<double> reference(ReferenceDescription(0.3), {});
  EXPECT_EQ(reference.at(0.0).value, 0.3);
  EXPECT_EQ(reference.at(7.0).value, 0.3);
  EXPECT_EQ(reference.at(7.0).rate, 0.0);
}

TEST(Reference, ASineHasFrequencyOrPeriodPhaseAndOffset) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSine;
  description.sine = {2.0, M_PI / 6.0, 0.5, 0.25, false};
  const Reference<double> by_frequency(description, {});
  EXPECT_NEAR(by_frequency.at(0.0).value, 1.5, 1e-14);
  EXPECT_NEAR(by_frequency.at(4.0 / 6.0).value, 0.5 + 2.0 * std::sin(M_PI / 2.0), 1e-14);
  description.sine.frequency = 4.0;
  description.sine.is_period = true;
  EXPECT_NEAR(Reference<double>(description, {}).at(0.9).value, by_frequency.at(0.9).value, 1e-14);
  expect_derivatives(by_frequency, 0.77);
}

/// scale f(t + delay) - offset by the parameters of these names.
ReferenceDescription sampled() {
  const std::vector<std::string> names{"scale", "delay", "offset"};
  const auto number = [&](double value, const std::string& name) {
    return Quantity(value, std::make_shared<const Expression>(name, names));
  };
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSampled;
  description.sampled = {
      std::make_shared<const SampledFunction>(std::vector<double>{0.0, 0.1, 0.2, 0.3}, std::vector<double>{1.0, 3.0, -2.0, 0.5}),
      number(2.0, "scale"), number(0.02, "delay"), number(0.3, "offset")};
  return description;
}

TEST(Reference, SamplesAreScaledEarlyByTheDelayAndLessTheOffset) {
  const Reference<double> reference(sampled(), {2.0, 0.02, 0.3});
  EXPECT_NEAR(reference.at(0.08).value, 2.0 * 3.0 - 0.3, 1e-13);
  EXPECT_NEAR(reference.at(0.5).value, 2.0 * 0.5 - 0.3, 1e-13) << "held";
  EXPECT_EQ(reference.at(0.5).rate, 0.0);
  for (double t : {0.03, 0.13, 0.22}) expect_derivatives(reference, t);
}

TEST(Reference, SamplesHaveDerivativesByScaleDelayAndOffset) {
  std::vector<Lanes<4>> parameters{2.0, 0.02, 0.3};
  for (int k = 0; k < 3; ++k) parameters[static_cast<std::size_t>(k)].v[k] = 1.0;
  const ReferenceMotion<Lanes<4>> m = Reference<Lanes<4>>(sampled(), parameters).at(0.13);
  const std::vector<double> at{2.0, 0.02, 0.3};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = [&](double x) {
      std::vector<double> moved = at;
      moved[k] = x;
      return Reference<double>(sampled(), moved).at(0.13).value;
    };
    EXPECT_NEAR(m.value.v[static_cast<int>(k)], ridders_derivative(value, at[k], 1e-2).value, 1e-9) << k;
  }
}

TEST(Reference, ParametersReachEveryNumber) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kSine;
  const std::vector<std::string> names{"A", "f"};
  description.sine.amplitude = Quantity(2.0, std::make_shared<const Expression>("A", names));
  description.sine.frequency = Quantity(0.5, std::make_shared<const Expression>("f", names));
  std::vector<Lanes<4>> parameters{2.0, 0.5};
  parameters[0].v[0] = 1.0;
  parameters[1].v[1] = 1.0;
  const ReferenceMotion<Lanes<4>> m = Reference<Lanes<4>>(description, parameters).at(0.3);
  const double angle = 2.0 * M_PI * 0.5 * 0.3;
  EXPECT_NEAR(m.value.v[0], std::sin(angle), 1e-14);
  EXPECT_NEAR(m.value.v[1], 2.0 * std::cos(angle) * 2.0 * M_PI * 0.3, 1e-13);
}

// Rest to rest over one second: the minimum-jerk polynomial 10 x^3 - 15 x^4 + 6 x^5.
TEST(Reference, AQuinticFromRestToRestIsTheKnownPolynomial) {
  const Reference<double> reference = through({Interpolation::kQuintic, {1.0, 2.0}, {0.0, 1.0}, {}, {}});
  for (double x : {0.1, 0.5, 0.8}) {
    EXPECT_NEAR(reference.at(1.0 + x).value, x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), 1e-14);
    expect_derivatives(reference, 1.0 + x);
  }
  EXPECT_EQ(reference.at(0.4).value, 0.0) << "before the first";
  EXPECT_EQ(reference.at(9.0).value, 1.0) << "held after the last";
  EXPECT_EQ(reference.at(9.0).rate, 0.0);
}

TEST(Reference, QuinticPiecesMeetInPositionVelocityAndAcceleration) {
  const WaypointsDescription given{
      Interpolation::kQuintic, {0.0, 0.7, 1.0, 2.5}, {0.0, 1.0, -0.5, 2.0}, {0.0, 3.0, -1.0, 0.0}, {0.0, 4.0, 2.0, 0.0}};
  WaypointsDescription chosen = given;
  chosen.velocities.clear();
  chosen.accelerations.clear();
  for (const WaypointsDescription& points : {given, chosen}) {
    const Reference<double> reference = through(points);
    for (std::size_t k = 0; k < points.times.size(); ++k) {
      const ReferenceMotion<double> before = reference.at(points.times[k] - 1e-9), after = reference.at(points.times[k]);
      EXPECT_NEAR(after.value, points.positions[k].nominal(), 1e-12);
      EXPECT_NEAR(before.value, after.value, 1e-7);
      EXPECT_NEAR(before.rate, after.rate, 1e-6);
      EXPECT_NEAR(before.acceleration, after.acceleration, 1e-5);
    }
    expect_derivatives(reference, 0.85);
  }
  EXPECT_NEAR(through(given).at(0.7).rate, 3.0, 1e-12);
  EXPECT_NEAR(through(given).at(0.7).acceleration, 4.0, 1e-12);
}

// At inner way-points on a parabola the chosen velocity and acceleration equal those of the parabola.
TEST(Reference, ChosenVelocitiesAndAccelerationsAreThoseOfAParabola) {
  std::vector<double> times{0.0, 0.5, 1.2, 1.5, 2.0, 3.0};
  std::vector<Quantity> positions;
  for (double t : times) positions.emplace_back(t * t);
  const Reference<double> reference = through({Interpolation::kQuintic, times, positions, {}, {}});
  EXPECT_NEAR(reference.at(1.2).rate, 2.4, 1e-12);
  EXPECT_NEAR(reference.at(1.2).acceleration, 2.0, 1e-11);
  EXPECT_NEAR(reference.at(1.3).value, 1.69, 1e-12) << "between two inner way-points";
}

TEST(Reference, CubicAndLinearPieces) {
  const Reference<double> cubic = through({Interpolation::kCubic, {0.0, 2.0}, {1.0, 3.0}, {0.5, -1.0}, {}});
  EXPECT_NEAR(cubic.at(0.0).rate, 0.5, 1e-14);
  EXPECT_NEAR(cubic.at(2.0 - 1e-12).rate, -1.0, 1e-9);
  EXPECT_NEAR(cubic.at(2.0 - 1e-12).value, 3.0, 1e-9);
  expect_derivatives(cubic, 0.9);
  const Reference<double> linear = through({Interpolation::kLinear, {0.0, 2.0, 3.0}, {1.0, 3.0, 0.0}, {}, {}});
  EXPECT_NEAR(linear.at(0.5).value, 1.5, 1e-14);
  EXPECT_NEAR(linear.at(2.5).rate, -3.0, 1e-14);
  EXPECT_NEAR(linear.at(2.5).value, 1.5, 1e-14);
}

}  // namespace
}  // namespace codesign
