// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/excursions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace codesign {
namespace {

std::vector<double> sorted(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times;
}

void expect_near(const std::vector<double>& times, const std::vector<double>& expected) {
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-8);
}

TEST(Excursions, ArePulsesBumpsAndDips) {
  // A bump over a slope of the other scan points: half of its height, sqrt(log 2) widths aside.
  const double width = 0.01, half = width * std::sqrt(std::log(2.0));
  const auto bump = [&](double t) { return std::exp(-std::pow((t - 2.0) / width, 2)); };
  const std::vector<double> found = sorted(excursions_of(bump, 5.0));
  ASSERT_EQ(found.size(), 3u);
  const std::vector<double> dips =
      sorted(excursions_of([&](double t) { return 3.0 - bump(t); }, 5.0));
  expect_near(dips, found);
  EXPECT_NEAR(found[0], 2.0 - half, 1e-3 * half);
  EXPECT_NEAR(found[2], 2.0 + half, 1e-3 * half);
}

// Its instants are those of the switch that makes it jump, located to rounding in the run.
TEST(Excursions, HaveNoInstantsAtJumps) {
  const auto pulse = [](double t) { return t > 0.503 && t < 0.505 ? 100.0 : 0.0; };
  expect_near(excursions_of(pulse, 1.0), {0.504});
  const auto tooth = [](double t) { return t < 0.1 ? t : 0.0; };
  EXPECT_EQ(excursions_of(tooth, 1.0).size(), 2U);
}

TEST(Excursions, AreNotWhatAnErrorTestSees) {
  for (const auto& function :
       {+[](double) { return 4.0; }, +[](double t) { return t * t; },
        +[](double t) { return t > 0.3 ? 1.0 : 0.0; }, +[](double t) { return std::sin(4.0 * t); },
        +[](double) { return std::numeric_limits<double>::quiet_NaN(); }})
    EXPECT_TRUE(excursions_of(function, 1.0).empty());
}

TEST(Excursions, OfAFastSineAreItsWaves) {
  const auto sine = [](double t) { return std::sin(40.0 * M_PI * t); };
  EXPECT_NEAR(static_cast<double>(excursions_of(sine, 1.0).size()), 3.0 * 40.0, 3.0);
}

}  // namespace
}  // namespace codesign
