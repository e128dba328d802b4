// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/whiteness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

Eigen::VectorXd series(double (*f)(double)) {
  return Eigen::VectorXd::NullaryExpr(100, [f](Eigen::Index k) { return f(static_cast<double>(k)); });
}
double wave(double k) { return std::sin(0.7 * k) + std::fmod(k * k, 7.0) / 5.0; }
double chirp(double k) { return std::cos(3.0 * k * k + 0.5 * k); }

// statsmodels 0.13.5: acorr_ljungbox(x, lags=[1, 3, 10]).
TEST(LjungBox, GivesTheNumbersOfStatsmodels) {
  const Whiteness one = ljung_box(series(wave), {100}, 1), three = ljung_box(series(wave), {100}, 3), ten = ljung_box(series(wave), {100});
  EXPECT_NEAR(one.statistic, 44.43457848900372, 1e-10);
  EXPECT_NEAR(one.probability / 2.630005432752963e-11, 1.0, 1e-9);
  EXPECT_NEAR(three.statistic, 62.452746721158036, 1e-10);
  EXPECT_EQ(ten.lags, 10);
  EXPECT_NEAR(ten.statistic, 361.61057587693165, 1e-9);
  EXPECT_NEAR(ten.probability / 1.3663292357336851e-71, 1.0, 1e-9);
  const Whiteness white = ljung_box(series(chirp), {100}, 10);
  EXPECT_NEAR(white.statistic, 5.641563445827559, 1e-9);
  EXPECT_NEAR(white.probability, 0.8444252034225589, 1e-11);
}

TEST(LjungBox, RecordingsHaveTheirOwnMeans) {
  Eigen::VectorXd two(200);
  two << series(chirp), series(chirp).array() + 100.0;
  EXPECT_GT(ljung_box(two, {100, 100}).probability, 0.1);
  EXPECT_LT(ljung_box(two, {200}).probability, 1e-10);
  EXPECT_GT(ljung_box(two, {200}).first_correlation, 0.9);
}

TEST(LjungBox, ZerosAreWhite) { EXPECT_EQ(ljung_box(Eigen::VectorXd::Zero(50), {50}).probability, 1.0); }

}  // namespace
}  // namespace codesign
