// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/formula_laws.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/scalar_agreement.h"

namespace codesign {
namespace {

Lanes<4> lane(double value, int k) {
  Lanes<4> x(value);
  x.v[k] = 1.0;
  return x;
}

// At the ends of domains slopes are infinite, and what does not depend on them has no part in it.
TEST(FormulaLaws, SlopesOfLanesAndComplexStepsAreExactAtTheEndsOfDomains) {
  struct End {
    FunctionKind kind;
    double at, slope;
  };
  for (const End& end : {End{FunctionKind::kSquareRoot, 0.0, HUGE_VAL},
                         {FunctionKind::kArcSine, 1.0, HUGE_VAL},
                         {FunctionKind::kArcCosine, -1.0, -HUGE_VAL},
                         {FunctionKind::kLogarithm, 0.0, HUGE_VAL},
                         {FunctionKind::kLogarithm10, 0.0, HUGE_VAL}}) {
    const Lanes<4> value = smooth_function(end.kind, lane(end.at, 2));
    EXPECT_EQ(value.v[2], end.slope);
    EXPECT_EQ(value.v[0], 0.0);
    EXPECT_EQ(value.a, smooth_function(end.kind, end.at));
    const std::complex<double> step =
        smooth_function(end.kind, std::complex<double>(end.at, 1e-30));
    EXPECT_EQ(step.imag(), end.slope);
    EXPECT_EQ(step.real(), value.a);
  }
  EXPECT_EQ(angle_of(Lanes<4>(0.0), Lanes<4>(0.0)).v[0], 0.0);
  EXPECT_TRUE(std::isnan(angle_of(lane(0.0, 0), Lanes<4>(0.0)).v[0]));
}

TEST(FormulaLaws, QuotientsHaveTheValueOfTheDouble) {
  for (double x = 1.0; x < 60.0; x += 1.0) {
    EXPECT_EQ(quotient(lane(x, 0), lane(49.0, 1)).a, x / 49.0);
    EXPECT_EQ(quotient(std::complex<double>(x, 1e-30), std::complex<double>(49.0)).real(),
              x / 49.0);
  }
  EXPECT_EQ(quotient(lane(3.0, 0), lane(4.0, 1)).v[1], -3.0 / 16.0);
}

// A function of what does not change in time does not change, also at the end of its domain.
TEST(FormulaLaws, AConstantSeriesHasTheLawsOfNumbers) {
  const Taylor<double> zero(0.0);
  for (const auto& series :
       {smooth_function(FunctionKind::kSquareRoot, zero), power(zero, Taylor<double>(0.5)),
        smooth_function(FunctionKind::kArcCosine, Taylor<double>(1.0)), angle_of(zero, zero)}) {
    EXPECT_EQ(series.c[0], 0.0);
    EXPECT_EQ(series.c[1], 0.0);
  }
}

// t^n and its derivatives n t^(n-1), n (n-1) t^(n-2), ...; c_k are those divided by k!.
TEST(FormulaLaws, PowersOfTheTimeAreExactAlsoAtZeroAndForNegativeTimes) {
  for (const double t : {-1.5, 0.0, 2.0})
    for (const double n : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
      const Taylor<double> series = power(Taylor<double>::time(t), Taylor<double>(n));
      double factor = 1.0;
      for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(series.c[to_index(k)], factor == 0.0 ? 0.0 : factor * std::pow(t, n - k), 1e-13)
            << t << "^" << n;
        factor *= (n - k) / (k + 1);
      }
    }
  const Taylor<double> root = power(Taylor<double>::time(4.0), Taylor<double>(0.5));
  EXPECT_EQ(root.c[0], 2.0);
  EXPECT_DOUBLE_EQ(root.c[1], 0.25);
  EXPECT_DOUBLE_EQ(root.c[2], -1.0 / 64.0);
}

// d/dn t^n = t^n log t, and of its rate t^(n-1) (1 + n log t).
TEST(FormulaLaws, PowersOfTheTimeHaveTheDerivativeByTheExponent) {
  const Taylor<Lanes<4>> t = Taylor<Lanes<4>>::time(3.0), n(lane(2.0, 1));
  const Taylor<Lanes<4>> series = power(t, n);
  EXPECT_DOUBLE_EQ(series.c[0].v[1], 9.0 * std::log(3.0));
  EXPECT_DOUBLE_EQ(series.c[1].v[1], 3.0 * (1.0 + 2.0 * std::log(3.0)));
  const Taylor<Lanes<4>> negative = power(Taylor<Lanes<4>>::time(-3.0), n);
  EXPECT_EQ(negative.c[0].a, 9.0);
  EXPECT_EQ(negative.c[1].a, -6.0);
  EXPECT_TRUE(std::isnan(negative.c[0].v[1]));
  EXPECT_EQ(negative.c[0].v[0], 0.0);
  const Taylor<Lanes<4>> start = power(Taylor<Lanes<4>>::time(0.0), n);
  for (const Lanes<4>& c : start.c) EXPECT_TRUE(std::isfinite(c.a));
  EXPECT_EQ(start.c[0].v[1], 0.0);
  EXPECT_EQ(start.c[1].v[1], 0.0);
}

Lanes<4> recorded_power(double base, double exponent, bool base_varies, bool exponent_varies) {
  return recorded_value<Lanes<4>>(Expression("x**n", {"x", "n"}),
                                  {lane(base, 0), lane(exponent, 1)},
                                  {!base_varies, !exponent_varies});
}

// The exponent is a number of the design: whole ones are found by decisions.
TEST(FormulaLaws, RecordedPowersOfAWholeExponentOfTheDesignAreProducts) {
  for (const bool base_varies : {true, false}) {
    for (const double n : {-64.0, -3.0, -1.0, 0.0, 1.0, 2.0, 3.0, 7.0, 64.0})
      for (const double x : {-1.25, 1.25}) {
        const Lanes<4> value = recorded_power(x, n, base_varies, false);
        const double exact = std::pow(x, n), slope = n == 0.0 ? 0.0 : n * std::pow(x, n - 1.0);
        EXPECT_NEAR(value.a, exact, 1e-13 * std::abs(exact)) << x << "^" << n;
        EXPECT_NEAR(value.v[0], slope, 1e-13 * std::abs(slope)) << x << "^" << n;
        if (x > 0.0)
          EXPECT_NEAR(value.v[1], exact * std::log(x), 1e-13 * std::abs(exact)) << n;
        else
          EXPECT_FALSE(std::isfinite(value.v[1])) << "there is no derivative by the exponent";
      }
    EXPECT_NEAR(recorded_power(2.0, 2.5, base_varies, false).a, std::pow(2.0, 2.5), 1e-14);
    EXPECT_TRUE(std::isnan(recorded_power(-2.0, 2.5, base_varies, false).a));
    EXPECT_EQ(recorded_power(0.0, 2.0, base_varies, false).a, 0.0);
    EXPECT_EQ(recorded_power(0.0, 2.0, base_varies, false).v[1], 0.0);
  }
  EXPECT_NEAR(recorded_power(2.0, 65.0, true, false).a, std::pow(2.0, 65.0), 1e6) << "by log";
  EXPECT_NEAR(recorded_power(2.0, 3.0, true, true).v[1], 8.0 * std::log(2.0), 1e-14);
}

TEST(FormulaLaws, RecordingsWithTheSameOutcomesAreTheSame) {
  const auto record = [](Recording* recording, double exponent) {
    const Traced x(recording, recording->leaf(0, 0, true)),
        n(recording, recording->leaf(0, 1, false), exponent);
    power(x, n);
    std::vector<bool> outcomes;
    for (const Recording::Guard& guard : recording->guards()) outcomes.push_back(guard.outcome);
    return outcomes;
  };
  Recording cube, followed;
  const std::vector<bool> outcomes = record(&cube, 3.0);
  followed.follow(outcomes);
  record(&followed, 2.0);
  ASSERT_EQ(cube.size(), followed.size());
  for (int n = 0; n < cube.size(); ++n) {
    EXPECT_EQ(cube.node(n).operation, followed.node(n).operation);
    EXPECT_EQ(cube.node(n).literal, followed.node(n).literal);
  }
}

TEST(FormulaLaws, ALargeWholeExponentOfTheTextIsAProduct) {
  const Expression expression("x**101", {"x"});
  EXPECT_NEAR(recorded_value<double>(expression, {-1.01}, {false}), std::pow(-1.01, 101.0), 1e-13);
}

TEST(FormulaLaws, RecordedHyperbolicSineAndArcCosineKeepTheirDigitsAtZero) {
  for (const double x : {1e-12, 1e-5, 0.3}) {
    EXPECT_NEAR(recorded_value<double>(Expression("sinh(x)", {"x"}), {x}, {false}), std::sinh(x),
                4e-16 * std::sinh(x));
    const double c = 1.0 - x;
    EXPECT_NEAR(recorded_value<double>(Expression("acos(x)", {"x"}), {c}, {false}), std::acos(c),
                4e-16 * std::acos(c));
  }
}

}  // namespace
}  // namespace codesign
