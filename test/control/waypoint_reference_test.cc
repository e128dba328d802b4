// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/waypoint_reference.h"

#include <algorithm>
#include <complex>
#include <random>

#include "control/reference_fixture.h"

namespace codesign {
namespace {

double value(const std::array<double, 6>& c, double t) {
  double sum = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * t + c[k];
  return sum;
}

double slope(const std::array<double, 6>& c, double t) {
  double sum = 0.0;
  for (std::size_t k = c.size() - 1; k > 0; --k) sum = sum * t + static_cast<double>(k) * c[k];
  return sum;
}

TEST(WaypointPolynomial, MeetsTheEndsInPositionAndFromTheThirdDegreeOnInVelocity) {
  const Knot<double> from{1.0, 2.0, -3.0}, to{-0.5, 4.0, 5.0};
  for (Interpolation degree :
       {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
    const auto c = waypoint_polynomial(degree, from, to, 0.5);
    EXPECT_EQ(value(c, 0.0), 1.0);
    EXPECT_NEAR(value(c, 0.5), -0.5, 1e-13);
    if (degree == Interpolation::kLinear) {
      EXPECT_NEAR(slope(c, 0.2), -3.0, 1e-13);
      continue;
    }
    EXPECT_EQ(slope(c, 0.0), 2.0);
    EXPECT_NEAR(slope(c, 0.5), 4.0, 1e-12);
  }
  EXPECT_EQ(waypoint_polynomial(Interpolation::kQuintic, from, to, 0.5)[2], -1.5);
}

// Rest to rest over one second: the minimum-jerk polynomial 10 x^3 - 15 x^4 + 6 x^5.
TEST(Reference, AQuinticFromRestToRestIsTheKnownPolynomial) {
  const Reference<double> reference =
      through({Interpolation::kQuintic, {1.0, 2.0}, {0.0, 1.0}, {}, {}});
  for (double x : {0.1, 0.5, 0.8}) {
    EXPECT_NEAR(reference.at(1.0 + x).value, x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), 1e-14);
    expect_derivatives(reference, 1.0 + x);
  }
  EXPECT_EQ(reference.at(0.4).value, 0.0) << "before the first";
  EXPECT_EQ(reference.at(9.0).value, 1.0) << "held after the last";
  EXPECT_EQ(reference.at(9.0).rate, 0.0);
}

TEST(Reference, QuinticPiecesMeetInPositionVelocityAndAcceleration) {
  const WaypointsDescription given{Interpolation::kQuintic,
                                   {0.0, 0.7, 1.0, 2.5},
                                   {0.0, 1.0, -0.5, 2.0},
                                   {0.0, 3.0, -1.0, 0.0},
                                   {0.0, 4.0, 2.0, 0.0}};
  WaypointsDescription chosen = given;
  chosen.velocities.clear();
  chosen.accelerations.clear();
  for (const WaypointsDescription& points : {given, chosen}) {
    const Reference<double> reference = through(points);
    for (std::size_t k = 0; k < points.times.size(); ++k) {
      const ReferenceMotion<double> before = reference.at(points.times[k] - 1e-9),
                                    after = reference.at(points.times[k]);
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

// At inner way-points on a parabola the chosen velocity and acceleration equal those of the
// parabola.
TEST(Reference, ChosenVelocitiesAndAccelerationsAreThoseOfAParabola) {
  std::vector<double> times{0.0, 0.5, 1.2, 1.5, 2.0, 3.0};
  std::vector<Quantity> positions;
  for (double t : times) positions.emplace_back(t * t);
  const Reference<double> reference = through({Interpolation::kQuintic, times, positions, {}, {}});
  EXPECT_NEAR(reference.at(1.2).rate, 2.4, 1e-12);
  EXPECT_NEAR(reference.at(1.2).acceleration, 2.0, 1e-11);
  EXPECT_NEAR(reference.at(1.3).value, 1.69, 1e-12) << "between two inner way-points";
}

/// Way-points at random distances, with rises, plateaus and turns.
WaypointsDescription random_points(unsigned seed) {
  std::mt19937 bits(seed);
  const auto number = [&bits] { return static_cast<double>(bits()) / 4294967296.0; };
  WaypointsDescription points;
  points.interpolation = Interpolation::kMonotone;
  double time = 0.0;
  for (int k = 0; k < 12; ++k) {
    points.times.push_back(time);
    points.positions.emplace_back(std::round(6.0 * number()) * (number() < 0.2 ? 20.0 : 1.0));
    time += std::pow(10.0, -3.0 * number());
  }
  return points;
}

// Each piece stays between its own two way-points, up to rounding, so that the curve has no
// extremum but at them.
TEST(Reference, AMonotoneCurveStaysBetweenNeighboursAndHasContinuousAccelerations) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const WaypointsDescription points = random_points(seed);
    const Reference<double> reference = through(points);
    for (std::size_t k = 0; k + 1 < points.times.size(); ++k) {
      const auto [low, high] =
          std::minmax({points.positions[k].nominal(), points.positions[k + 1].nominal()});
      for (int i = 0; i <= 50; ++i) {
        const double time = points.times[k] + (points.times[k + 1] - points.times[k]) * i / 50,
                     value = reference.at(time).value;
        ASSERT_TRUE(value >= low - 1e-9 && value <= high + 1e-9)
            << value << " at " << time << ", seed " << seed;
      }
      const ReferenceMotion<double> before = reference.at(points.times[k] - 1e-11),
                                    after = reference.at(points.times[k]);
      EXPECT_NEAR(before.rate, after.rate, 1e-6 * (1.0 + std::abs(after.acceleration)));
      EXPECT_NEAR(before.acceleration, after.acceleration,
                  1e-7 * (1.0 + std::abs(before.jerk) + std::abs(after.jerk)));
    }
  }
}

TEST(Reference, ShortIntervalsDoNotThrowAMonotoneCurveAside) {
  const std::vector<double> times{0.0, 2.0, 2.05, 2.1};
  const std::vector<Quantity> positions{0.0, 0.0, 0.05, 0.0};
  EXPECT_GT(through({Interpolation::kQuintic, times, positions, {}, {}}).at(1.2).value, 1.0);
  EXPECT_EQ(through({Interpolation::kMonotone, times, positions, {}, {}}).at(1.2).value, 0.0);
}

// Where no limit applies, nothing changes.
TEST(Reference, AMonotoneCurveThroughAGentleCourseIsTheQuintic) {
  const std::vector<double> times{0.0, 1.0, 2.1, 3.0, 4.0};
  const std::vector<Quantity> positions{0.0, 1.0, 2.15, 3.1, 4.0};
  const Reference<double> quintic = through({Interpolation::kQuintic, times, positions, {}, {}}),
                          monotone = through({Interpolation::kMonotone, times, positions, {}, {}});
  for (const double t : {0.5, 1.5, 2.5, 3.5}) EXPECT_EQ(monotone.at(t).value, quintic.at(t).value);
}

TEST(Reference, AMonotoneCurveHasExactDerivativesByItsWayPoints) {
  const std::vector<std::string> names{"a", "b", "c"};
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kWaypoints;
  description.waypoints = {Interpolation::kMonotone, {0.0, 0.3, 1.0, 1.2, 2.0}, {0.0}, {}, {}};
  for (const std::string& name : names)
    description.waypoints.positions.emplace_back(1.0,
                                                 std::make_shared<const Expression>(name, names));
  description.waypoints.positions.emplace_back(3.0);
  const std::vector<double> at{1.0, 1.2, 2.9};  // limited velocities and accelerations among them
  for (const double t : {0.1, 0.5, 1.1, 1.6})
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto moved = [&](auto step) {
        std::vector<decltype(step)> parameters(at.begin(), at.end());
        parameters[k] += step;
        return Reference<decltype(step)>(description, parameters).at(t);
      };
      const ReferenceMotion<std::complex<double>> m = moved(std::complex<double>(0.0, 1e-30));
      const auto difference = [&](const auto& f) { return ridders_derivative(f, 0.0, 1e-2).value; };
      EXPECT_NEAR(m.value.imag() / 1e-30, difference([&](double x) { return moved(x).value; }),
                  1e-9)
          << t << ", " << k;
      EXPECT_NEAR(m.acceleration.imag() / 1e-30,
                  difference([&](double x) { return moved(x).acceleration; }), 1e-6)
          << t << ", " << k;
    }
}

TEST(Reference, CubicAndLinearPieces) {
  const Reference<double> cubic =
      through({Interpolation::kCubic, {0.0, 2.0}, {1.0, 3.0}, {0.5, -1.0}, {}});
  EXPECT_NEAR(cubic.at(0.0).rate, 0.5, 1e-14);
  EXPECT_NEAR(cubic.at(2.0 - 1e-12).rate, -1.0, 1e-9);
  EXPECT_NEAR(cubic.at(2.0 - 1e-12).value, 3.0, 1e-9);
  expect_derivatives(cubic, 0.9);
  const Reference<double> linear =
      through({Interpolation::kLinear, {0.0, 2.0, 3.0}, {1.0, 3.0, 0.0}, {}, {}});
  EXPECT_NEAR(linear.at(0.5).value, 1.5, 1e-14);
  EXPECT_NEAR(linear.at(2.5).rate, -3.0, 1e-14);
  EXPECT_NEAR(linear.at(2.5).value, 1.5, 1e-14);
}

}  // namespace
}  // namespace codesign
