// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "control/reference.h"
#include "math/differences.h"

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
  EXPECT_NEAR(m.rate, difference([&](double x) { return reference.at(x).value; }),
              1e-8 * (1.0 + std::abs(m.rate)));
  EXPECT_NEAR(m.acceleration, difference([&](double x) { return reference.at(x).rate; }),
              1e-8 * (1.0 + std::abs(m.acceleration)));
  EXPECT_NEAR(m.jerk, difference([&](double x) { return reference.at(x).acceleration; }),
              1e-8 * (1.0 + std::abs(m.jerk)));
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
      std::make_shared<const SampledFunction>(std::vector<double>{0.0, 0.1, 0.2, 0.3},
                                              std::vector<double>{1.0, 3.0, -2.0, 0.5}),
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
    EXPECT_NEAR(m.value.v[static_cast<int>(k)], ridders_derivative(value, at[k], 1e-2).value, 1e-9)
        << k;
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

const std::vector<double> kCoefficients{1.0, -2.0, 0.5, 3.0, 4.0};

BasisDescription basis(BasisShape shape) {
  BasisDescription b;
  b.shape = shape;
  b.duration = 2.0;
  b.coefficients.assign(kCoefficients.begin(), kCoefficients.end());
  return b;
}

TEST(ShapedInput, LinearRunsThroughItsCoefficientsAndHoldsTheLast) {
  const BasisDescription b = basis(BasisShape::kLinear);
  const ShapedInput<double> input(b, {});
  for (int k = 0; k < 5; ++k)
    EXPECT_NEAR(input.at(0.5 * k).value, kCoefficients[static_cast<std::size_t>(k)], 1e-15);
  EXPECT_NEAR(input.at(0.25).rate, -6.0, 1e-14);
  EXPECT_EQ(input.at(7.0).value, 4.0);
  EXPECT_EQ(input.at(7.0).rate, 0.0);
}

TEST(ShapedInput, CubicHasTheRateOfItsValues) {
  const BasisDescription b = basis(BasisShape::kCubic);
  const ShapedInput<double> input(b, {});
  EXPECT_NEAR(input.at(0.0).value, 1.0, 1e-15);
  for (double t : {0.3, 0.9, 1.7}) {
    const double rate =
        ridders_derivative([&](double s) { return input.at(s).value; }, t, 0.05).value;
    EXPECT_NEAR(input.at(t).rate, rate, 1e-9);
  }
}

TEST(ShapedInput, DerivativesByCoefficientsAreTheWeights) {
  BasisDescription b = basis(BasisShape::kCubic);
  b.coefficients[2] =
      Quantity(kCoefficients[2], std::make_shared<Expression>("c", std::vector<std::string>{"c"}));
  Lanes<4> c(kCoefficients[2]);
  c.v[1] = 1.0;
  const ShapedInput<Lanes<4>> input(b, {c});
  const BasisWeights weights = basis_weights(b, 0.9);
  EXPECT_NEAR(input.at(0.9).value.v[1], weights.value[static_cast<std::size_t>(2 - weights.first)],
              1e-15);
}

ReferenceDescription expression_of(const std::string& text, const std::vector<std::string>& names) {
  ReferenceDescription description;
  description.kind = ReferenceDescription::Kind::kExpression;
  description.expression = {std::make_shared<const Expression>(text, names),
                            static_cast<int>(names.size()) - 1};
  return description;
}

TEST(Reference, AnExpressionHasThreeDerivatives) {
  const ReferenceDescription description =
      expression_of("A*sin(3*t)*exp(-t) + (t < 1 ? t^2 : 2*t - 1)", {"A", "t"});
  const Reference<double> reference(description, {0.7});
  for (double t : {0.4, 1.6}) {
    expect_derivatives(reference, t);
    EXPECT_NEAR(reference.at(t).value,
                0.7 * std::sin(3.0 * t) * std::exp(-t) + (t < 1.0 ? t * t : 2.0 * t - 1.0), 1e-15);
  }
  using L = Lanes<4>;
  const Reference<L> lanes(description, {L(0.7, L::Vector{1.0, 0.0, 0.0, 0.0})});
  EXPECT_NEAR(lanes.at(0.4).rate.v[0], std::exp(-0.4) * (3.0 * std::cos(1.2) - std::sin(1.2)),
              1e-14);
  EXPECT_EQ(dependencies(description), std::vector<int>{0});
}

}  // namespace

}  // namespace codesign
