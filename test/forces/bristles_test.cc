// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "forces/bristle_fixture.h"
#include "forces/bristles.h"

namespace codesign {
namespace {

// mu_s = 0.5, mu_d = 0.4, v_s = 0.01 m/s, sigma_0 = 1000 1/m, sigma_1 = 5 s/m, tau_dw = 2 s: tau_br
// = 5 ms.
Bristle<double> at(double u, double zeta, double dwell) {
  return gonthier<double>({u, 0.0, 0.0}, {{zeta, 0.0, 0.0}, dwell}, bristle_constants<double>());
}

TEST(Gonthier, NothingMovesAtRest) {
  const Bristle<double> b = at(0.0, 0.0, 0.0);
  EXPECT_EQ(b.mu.norm(), 0.0);
  EXPECT_EQ(b.rate.norm(), 0.0);
  EXPECT_DOUBLE_EQ(b.dwell_rate, 0.5);  // (1 - 0)/2 s
}

TEST(Gonthier, AtTheStribeckVelocity) {
  // s = 1/e. f = s (0.1 + 0.05) + (1 - s) 0.4 = 0.308030..., below the cut at 0.4 + 0.1 * 0.25.
  const double s = std::exp(-1.0);
  const Bristle<double> b = at(0.01, 0.1, 0.25);
  EXPECT_NEAR(b.mu[0], s * 0.15 + (1.0 - s) * 0.4, 1e-15);
  EXPECT_NEAR(b.rate[0], 10.0 * s + (1.0 - s) * 200.0 * 0.3, 1e-12);
  EXPECT_NEAR(b.dwell_rate, (s - 0.25) / 2.0, 1e-15);
}

TEST(Gonthier, CutsOffAtWhatTheDwellStateHolds) {
  // f = s (1 + 0.05) + (1 - s) 0.4 = 0.639: cut at 0.4 + 0.1 * 0.25 = 0.425; s < 0.5 in the second,
  // so the dwell state falls within 5 ms.
  const Bristle<double> b = at(0.01, 1.0, 0.25);
  EXPECT_NEAR(b.mu[0], 0.425, 1e-15);
  EXPECT_NEAR(at(0.01, 1.0, 0.5).dwell_rate, (std::exp(-1.0) - 0.5) / 0.005, 1e-12);
}

TEST(Gonthier, SlidingItIsCoulombs) {
  for (double u : {0.2, -0.2, 3.0}) {
    const double sign = u < 0.0 ? -1.0 : 1.0;
    for (double zeta : {-0.4, 0.0, 0.3})
      EXPECT_NEAR(at(u, zeta, 0.0).mu[0], 0.4 * sign, 1e-15) << "whatever the deflection";
    EXPECT_NEAR(at(u, 0.4 * sign, 0.0).rate[0], 0.0, 1e-12);
  }
}

TEST(Gonthier, DirectionMeetsItsParabola) {
  const double edge = 1e-3;
  const double below = direction_per_speed(edge * edge * (1.0 - 1e-12), edge),
               above = direction_per_speed(edge * edge, edge);
  EXPECT_NEAR(below / above, 1.0, 1e-11);
  const auto slope = [edge](double square) {
    return direction_per_speed(Complex(square, 1e-30), Complex(edge)).imag() / 1e-30;
  };
  EXPECT_NEAR(slope(edge * edge * (1.0 - 1e-12)) / slope(edge * edge), 1.0, 1e-11);
  EXPECT_DOUBLE_EQ(above, 1000.0);
  EXPECT_DOUBLE_EQ(direction_per_speed(0.0, edge), 1500.0);
}

TEST(Gonthier, SaturationIsContinuous) {
  const Eigen::Vector3d x(0.3, -0.4, 0.0);
  EXPECT_EQ(cut_off<double>(x, 0.5), x);
  EXPECT_NEAR((cut_off<double>(x, 0.5 * (1.0 - 1e-13)) - x).norm(), 0.0, 1e-12);
  EXPECT_NEAR((cut_off<double>(x, 0.25) - 0.5 * x).norm(), 0.0, 1e-16);
  EXPECT_EQ(cut_off<double>(Eigen::Vector3d::Zero(), 0.0).norm(), 0.0);
  EXPECT_EQ(cut_off<double>(x, 0.0).norm(), 0.0);
}

TEST(Gonthier, DoesNotDependOnTheDirection) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d u(0.004, -0.006, 0.002), zeta(0.3, 0.1, -0.2);
  const auto c = bristle_constants<double>();
  const Bristle<double> b = gonthier<double>(u, {zeta, 0.3}, c),
                        turned = gonthier<double>(R * u, {R * zeta, 0.3}, c);
  EXPECT_NEAR((turned.mu - R * b.mu).norm(), 0.0, 1e-14);
  EXPECT_NEAR((turned.rate - R * b.rate).norm(), 0.0, 1e-11);
  EXPECT_NEAR(turned.dwell_rate, b.dwell_rate, 1e-13);
}

TEST(Gonthier, ParametersEnterTheLanes) {
  expect_parameter_derivatives(gonthier<Lanes<8>>, gonthier<std::complex<double>>);
}

Bristle<double> at(double u, double zeta) {
  return lugre<double>({u, 0.0, 0.0}, {{zeta, 0.0, 0.0}, 0.0}, bristle_constants<double>());
}

TEST(LuGre, AtRestItIsASpringAndADamper) {
  const Bristle<double> b = at(0.0, 0.3);
  EXPECT_EQ(b.mu[0], 0.3);
  EXPECT_EQ(b.rate.norm(), 0.0);
}

TEST(LuGre, AtTheStribeckVelocity) {
  // g = 0.4 + 0.1/e; zeta' = 1000 (0.01 - 0.01/g 0.2).
  const double g = 0.4 + 0.1 * std::exp(-1.0), rate = 1000.0 * (0.01 - 0.01 / g * 0.2);
  const Bristle<double> b = at(0.01, 0.2);
  EXPECT_NEAR(b.rate[0], rate, 1e-12);
  EXPECT_NEAR(b.mu[0], 0.2 + 0.005 * rate, 1e-14);
  EXPECT_NEAR(at(-0.01, -0.2).mu[0], -b.mu[0], 1e-16) << "odd";
}

TEST(LuGre, SteadySlidingIsTheStribeckCurve) {
  for (double u : {1e-6, 0.003, 0.02, 1.0}) {
    const double g = 0.4 + 0.1 * std::exp(-u * u / 1e-4);
    EXPECT_NEAR(at(u, g).mu[0], g, 1e-14);
    EXPECT_NEAR(at(u, g).rate[0], 0.0, 1e-9);
  }
}

TEST(LuGre, DoesNotDependOnTheDirection) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d u(0.004, -0.006, 0.002), zeta(0.3, 0.1, -0.2);
  const auto c = bristle_constants<double>();
  const Bristle<double> b = lugre<double>(u, {zeta, 0.0}, c),
                        turned = lugre<double>(R * u, {R * zeta, 0.0}, c);
  EXPECT_NEAR((turned.mu - R * b.mu).norm(), 0.0, 1e-14);
  EXPECT_NEAR((turned.rate - R * b.rate).norm(), 0.0, 1e-11);
}

/// The rates and the friction of a contact in the states that it starts with.
Bristle<double> steady_at(const FrictionModel& model, const Eigen::Vector3d& u) {
  const auto c = bristle_constants<double>();
  return model->bristle.of<double>(u, model->steady.of<double>(u, c), c);
}

TEST(SteadyBristles, LuGreSlidesWithTheStribeckCurveAndNothingChanges) {
  for (double speed : {1e-4, 0.003, 0.02, 1.0, 1e6}) {
    const Eigen::Vector3d u(0.6 * speed, -0.8 * speed, 0.0);
    const double g = 0.4 + 0.1 * std::exp(-speed * speed / 1e-4);
    const Bristle<double> b = steady_at(FrictionModel::kLuGre, u);
    EXPECT_NEAR((b.mu - g * u / speed).norm(), 0.0, 1e-13) << speed;
    EXPECT_NEAR(b.rate.norm(), 0.0, 1e-9 * (1.0 + speed)) << speed;
  }
}

TEST(SteadyBristles, GonthierSlidesAsItDoesAfterLong) {
  for (double speed : {1e-4, 0.003, 0.008, 0.012, 0.03, 1.0, 1e6}) {
    const Eigen::Vector3d u(0.6 * speed, -0.8 * speed, 0.0);
    const double s = std::exp(-speed * speed / 1e-4);
    const auto c = bristle_constants<double>();
    const BristleState<double> state = steady_gonthier<double>(u, c);
    const Bristle<double> b = gonthier<double>(u, state, c);
    EXPECT_NEAR(b.dwell_rate, 0.0, 1e-12) << speed;
    EXPECT_NEAR(b.mu.norm(), std::min(0.4 + 5.0 * s * speed / (1.0 - s), 0.4 + 0.1 * s), 1e-12)
        << speed << ": the friction of zeta' = 0, cut off";
    EXPECT_NEAR((b.mu.normalized() - u / speed).norm(), 0.0, 1e-12);
    EXPECT_LE(state.zeta.norm(), 0.4 + 0.1 * s + 1e-12);
    if (state.zeta.norm() < 0.4 + 0.1 * s - 1e-9) {
      EXPECT_NEAR(b.rate.norm(), 0.0, 1e-9) << speed;
    }
  }
}

TEST(SteadyBristles, AtRestTheyAreLooseAndRoundingDeflectsNothing) {
  for (const FrictionModel& model : {FrictionModel::kLuGre, FrictionModel::kGonthier}) {
    const auto c = bristle_constants<double>();
    const auto at = [&](double u) {
      return model->steady.of<double>(Eigen::Vector3d(u, 0.0, 0.0), c);
    };
    EXPECT_EQ(at(0.0).zeta.norm(), 0.0) << model->name;
    EXPECT_EQ(at(0.0).dwell, 0.0);
    EXPECT_LT(at(1e-17).zeta.norm(), 1e-11);
    EXPECT_LT(at(1e-17).dwell, 1e-20);
    const double edge = kSteadyVelocity * 0.01;
    for (const double u : {edge, 0.01}) {
      EXPECT_NEAR(at(u * (1.0 - 1e-12)).zeta[0], at(u * (1.0 + 1e-12)).zeta[0], 1e-9) << u;
      EXPECT_NEAR(at(u * (1.0 - 1e-12)).dwell, at(u * (1.0 + 1e-12)).dwell, 1e-9) << u;
    }
    EXPECT_EQ(at(-0.02).zeta[0], -at(0.02).zeta[0]);
  }
}

TEST(LuGre, ParametersEnterTheLanes) {
  expect_parameter_derivatives(lugre<Lanes<8>>, lugre<std::complex<double>>);
}

}  // namespace

}  // namespace codesign
