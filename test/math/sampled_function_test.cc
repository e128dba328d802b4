// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/sampled_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace codesign {
namespace {

SampledFunction uneven() { return {{0.0, 0.1, 0.25, 0.3, 0.5}, {1.0, 2.0, -1.0, 0.5, 0.0}}; }

TEST(SampledFunction, PassesThroughItsSamplesAndIsHeldOutside) {
  const SampledFunction recorded = uneven();
  EXPECT_NEAR(recorded.at(0.1).value, 2.0, 1e-15);
  EXPECT_NEAR(recorded.at(0.25).value, -1.0, 1e-15);
  EXPECT_NEAR(recorded.at(0.5).value, 0.0, 1e-15);
  EXPECT_EQ(recorded.at(-1.0).value, 1.0);
  EXPECT_EQ(recorded.at(0.7).value, 0.0);
  EXPECT_EQ(recorded.at(0.7).slope, 0.0);
  EXPECT_TRUE(recorded.covers(0.5));
  EXPECT_FALSE(recorded.covers(0.51));
  EXPECT_FALSE(recorded.covers(-0.01));
}

TEST(SampledFunction, AParabolaIsReproduced) {
  std::vector<double> times, values;
  for (int k = 0; k < 8; ++k) {
    times.push_back(0.1 * k + 0.02 * std::sin(k));
    values.push_back(1.0 + 2.0 * times.back() - 3.0 * times.back() * times.back());
  }
  const SampledFunction recorded(times, values);
  for (double t = 0.01; t < 0.7; t += 0.013) {
    EXPECT_NEAR(recorded.at(t).value, 1.0 + 2.0 * t - 3.0 * t * t, 1e-13);
    EXPECT_NEAR(recorded.at(t).slope, 2.0 - 6.0 * t, 1e-12);
    EXPECT_NEAR(recorded.at(t).second, -6.0, 1e-10);
    EXPECT_NEAR(recorded.at(t).third, 0.0, 1e-8);
  }
}

TEST(SampledFunction, TheSlopeIsContinuousAtTheSamples) {
  const SampledFunction recorded = uneven();
  for (double t : {0.1, 0.25, 0.3})
    EXPECT_NEAR(recorded.at(t - 1e-10).slope, recorded.at(t + 1e-10).slope, 1e-5);
}

TEST(SampledFunction, OneSampleAndTwoSamples) {
  EXPECT_EQ(SampledFunction({1.0}, {3.0}).at(1.0).value, 3.0);
  EXPECT_NEAR(SampledFunction({1.0, 2.0}, {3.0, 5.0}).at(1.25).value, 3.5, 1e-15);
  EXPECT_THROW(SampledFunction({}, {}), std::invalid_argument);
  EXPECT_THROW(SampledFunction({0.0, 0.0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(SampledFunction({0.0, 1.0}, {1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace codesign
