// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/taylor_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

using Series = Taylor<double>;

TEST(TaylorQuadrature, IsExactToTheSeventhDegree) {
  const auto power = [](double t, int degree) {
    Series result(1.0);
    for (int k = 0; k < degree; ++k) result = result * Series::time(t);
    return result;
  };
  const double a = 0.4, b = 1.3;
  for (int degree = 0; degree <= 8; ++degree) {
    const double area = panel_integral(power(a, degree), power(b, degree), b - a),
                 exact = (std::pow(b, degree + 1) - std::pow(a, degree + 1)) / (degree + 1);
    if (degree < 7) {
      EXPECT_NEAR(panel_change(power(a, degree), power(b, degree), b - a),
                  std::pow(b, degree) - std::pow(a, degree), 1e-14);
    }
    if (degree < 8) {
      EXPECT_NEAR(area, exact, 1e-14) << degree;
    } else {
      EXPECT_GT(std::abs(area - exact), 1e-7);
    }
  }
}

TEST(TaylorQuadrature, PanelsAreFineWhereTheFunctionIs) {
  const auto smooth = [](double t) { return sin(Series::time(t)); };
  EXPECT_LE(integration_panels(smooth, 1.0).size(), 65U);
  const auto kink = [](double t) { return t < 0.3 ? Series(0.0) : Series::time(t) - Series(0.3); };
  const std::vector<double> ends = integration_panels(kink, 1.0);
  EXPECT_EQ(ends.front(), 0.0);
  EXPECT_EQ(ends.back(), 1.0);
  double area = 0.0, narrowest = 1.0;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    area += panel_integral(kink(ends[k - 1]), kink(ends[k]), ends[k] - ends[k - 1]);
    narrowest = std::min(narrowest, ends[k] - ends[k - 1]);
  }
  EXPECT_NEAR(area, 0.5 * 0.7 * 0.7, 1e-14);
  EXPECT_LT(narrowest, 1e-12);
  EXPECT_FALSE(find_jump(kink, 1.0));
}

TEST(TaylorQuadrature, FindsJumps) {
  const auto jump = [](double t) { return Series(t < 0.3 ? 1.0 : 2.0); };
  ASSERT_TRUE(find_jump(jump, 2.0));
  EXPECT_NEAR(*find_jump(jump, 2.0), 0.3, 1e-10);
}

}  // namespace
}  // namespace codesign
