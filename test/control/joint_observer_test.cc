// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/joint_observer.h"

#include <gtest/gtest.h>

#include "math/arrays.h"

namespace codesign {
namespace {

constexpr double kTime = 0.004;  // [s]

ObserverDescription observer(bool has_disturbance) {
  ObserverDescription of;
  of.inertia = Quantity(1.7);
  of.has_disturbance = has_disturbance;
  return of;
}

void expect_gains(const ObserverDescription& of, double sample_time,
                  const std::vector<double>& expected) {
  const JointObserver<double> found = joint_observer<double>(of, sample_time, {});
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(of.order()));
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found.gains[k], expected[k], 1e-9 * std::abs(expected[k])) << k;
}

// scipy.signal.place_poles of the transposed model, of the sampled one by the inverse of its map.
TEST(JointObserver, PlacesPoles) {
  ObserverDescription two = observer(false), three = observer(true);
  two.real = {-20.0, -25.0};
  two.imaginary = {0.0, 0.0};
  three.real = {-20.0, -15.0, -15.0};
  three.imaginary = {0.0, 10.0, -10.0};
  expect_gains(two, 0.0, {45.0, 500.0});
  expect_gains(three, 0.0, {50.0, 925.0, 6500.0});
  expect_gains(two, kTime, {0.16472978858872678, 1.8291117471691274});
  expect_gains(three, kTime, {0.18126924692201574, 3.350918530270512, 23.535969556102124});
}

TEST(JointObserver, OfABandwidthPlacesAllPolesAlike) {
  for (const double sample_time : {0.0, kTime})
    for (const bool has_disturbance : {false, true}) {
      ObserverDescription by_bandwidth = observer(has_disturbance), by_poles = by_bandwidth;
      by_bandwidth.bandwidth = Quantity(6.0);
      const auto count = static_cast<std::size_t>(by_poles.order());
      by_poles.real.assign(count, -6.0 * 6.283185307179586);
      by_poles.imaginary.assign(count, 0.0);
      const auto expected = joint_observer<double>(by_poles, sample_time, {}).gains;
      expect_gains(by_bandwidth, sample_time,
                   {expected.begin(), expected.begin() + to_signed(count)});
    }
}

// scipy.linalg.solve_continuous_are and solve_discrete_are, SciPy 1.10.
TEST(JointObserver, IsTheKalmanFilterOfItsNoise) {
  for (const bool has_disturbance : {false, true}) {
    ObserverDescription of = observer(has_disturbance);
    of.process = Quantity(3.0);
    of.measurement = Quantity(2e-6);
    if (has_disturbance)
      expect_gains(of, 0.0, {17.929254490870, 160.72908329947, 720.43815964163});
    else
      expect_gains(of, 0.0, {37.95887668629912, 720.4381596420843});
  }
  ObserverDescription sampled = observer(false);
  sampled.process = Quantity(3.0);
  sampled.measurement = Quantity(1e-8);
  expect_gains(sampled, kTime, {0.8959494211816055, 207.85666356639254});
}

}  // namespace
}  // namespace codesign
