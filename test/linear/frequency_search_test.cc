// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/frequency_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

namespace codesign {
namespace {

Pole pole_at(double real, double imaginary) {
  Pole pole;
  pole.value = {real, imaginary};
  return pole;
}

TEST(FrequencySearch, TheGridGoesAcrossAllPoles) {
  const std::vector<double> grid =
      frequencies_about({pole_at(-0.1, 0.0)}, {pole_at(-2.0, 50.0)}, 0.0);
  EXPECT_TRUE(std::is_sorted(grid.begin(), grid.end()));
  EXPECT_NEAR(grid.front(), 1e-4, 1e-12);
  EXPECT_NEAR(grid.back(), 1e3 * std::hypot(2.0, 50.0), 1e-6);
  EXPECT_TRUE(std::binary_search(grid.begin(), grid.end(), std::hypot(2.0, 50.0)));
  EXPECT_NEAR(frequencies_about({pole_at(-0.1, 0.0)}, {}, 0.01).back(), 100.0 * kHalfTurn, 1e-9);
}

TEST(FrequencySearch, ZerosAndPeaks) {
  EXPECT_NEAR(zero_between(1.0, 2.0, [](double x) { return x * x - 2.0; }), std::sqrt(2.0), 1e-15);
  const std::vector<double> grid{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  const std::vector<AtFrequency> found = peaks(grid, [](double x) {
    return std::exp(-std::pow(x - 1.3, 2)) + 2.0 * std::exp(-std::pow(x - 5.2, 2));
  });
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].frequency, 5.2, 1e-6);
  EXPECT_NEAR(found[0].value, 2.0, 1e-6);
  EXPECT_NEAR(found[1].frequency, 1.3, 1e-5);
  std::vector<AtFrequency> margins{{3.0, 1.0}, {2.0, 5.0}};
  EXPECT_EQ(sort_margins(&margins, std::less<>())->frequency, 5.0);
  margins.clear();
  EXPECT_FALSE(sort_margins(&margins, std::less<>()));
}

}  // namespace
}  // namespace codesign
