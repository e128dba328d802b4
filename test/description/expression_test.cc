// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression.h"

#include <gtest/gtest.h>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace codesign {
namespace {

const std::vector<std::string> kNames = {"x", "y", "i", "e"};
const std::vector<double> kAt = {0.7, -1.3, 2.0, 5.0};

double value_of_text(const std::string& text) { return Expression(text, kNames).value(kAt); }

TEST(ExpressionFunctions, ComputesAsPythonDoes) {
  EXPECT_DOUBLE_EQ(value_of_text("1 + 2*3 - 4/8"), 6.5);
  EXPECT_DOUBLE_EQ(value_of_text("1/3"), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("2**3**2"), 512.0);
  EXPECT_DOUBLE_EQ(value_of_text("2^-1"), 0.5);
  EXPECT_DOUBLE_EQ(value_of_text("-2**2"), -4.0);
  EXPECT_DOUBLE_EQ(value_of_text("(-2)**3"), -8.0);
  EXPECT_DOUBLE_EQ(value_of_text("+x - -y"), 0.7 - 1.3);
  EXPECT_DOUBLE_EQ(value_of_text("2.5e-1*1E2 + .5"), 25.5);
  EXPECT_DOUBLE_EQ(value_of_text("i*e"), 10.0);
  EXPECT_DOUBLE_EQ(value_of_text("x < 1 ? 3 : 4"), 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("x >= 1 ? 1 : y == -1.3 ? 5 : 6"), 5.0);
  EXPECT_DOUBLE_EQ(value_of_text("min(3, x, 2) + max(y, x)"), 1.4);
  EXPECT_DOUBLE_EQ(value_of_text("abs(y) + sign(y) + floor(y) + ceil(y)"), 1.3 - 1.0 - 2.0 - 1.0);
  EXPECT_DOUBLE_EQ(value_of_text("degrees(pi) + radians(180)"), 180.0 + M_PI);
  EXPECT_DOUBLE_EQ(value_of_text("log(x) + log10(100) + exp(0)"), std::log(0.7) + 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("atan2(y, -x)"), std::atan2(-1.3, -0.7));
}

TEST(ExpressionFunctions, DerivativesAreExact) {
  struct Case {
    const char* text;
    double dx, dy;
  };
  const double x = kAt[0], y = kAt[1], r2 = x * x + y * y;
  const std::vector<Case> cases = {
      {"x*y", y, x},
      {"x/y", 1.0 / y, -x / (y * y)},
      {"x**3", 3.0 * x * x, 0.0},
      {"y**3", 0.0, 3.0 * y * y},
      {"pow(y, 2)", 0.0, 2.0 * y},
      {"x**-2", -2.0 / (x * x * x), 0.0},
      {"x**2.5", 2.5 * std::pow(x, 1.5), 0.0},
      {"x**y", y * std::pow(x, y - 1.0), std::pow(x, y) * std::log(x)},
      {"(x - 0.7)**2", 0.0, 0.0},
      {"(x - 0.7)**1", 1.0, 0.0},
      {"sqrt(x)", 0.5 / std::sqrt(x), 0.0},
      {"sin(x) + cos(y) + tan(x)", std::cos(x) + 1.0 + std::tan(x) * std::tan(x), -std::sin(y)},
      {"asin(x) - acos(x)", 2.0 / std::sqrt(1.0 - x * x), 0.0},
      {"atan(y)", 0.0, 1.0 / (1.0 + y * y)},
      {"atan2(y, x)", -y / r2, x / r2},
      {"sinh(x)*cosh(x)", std::cosh(2.0 * x), 0.0},
      {"tanh(x)", 1.0 - std::tanh(x) * std::tanh(x), 0.0},
      {"exp(x*y)", y * std::exp(x * y), x * std::exp(x * y)},
      {"log(x)", 1.0 / x, 0.0},
      {"log10(x)", 1.0 / (x * std::log(10.0)), 0.0},
      {"abs(x) + abs(y)", 1.0, -1.0},
      {"max(x, y) - 2*min(x, y)", 1.0, -2.0},
      {"x > y ? x**2 : y", 2.0 * x, 0.0},
      {"degrees(x) + radians(y)", 180.0 / M_PI, M_PI / 180.0},
      {"floor(x) + sign(y) + ceil(y)", 0.0, 0.0},
  };
  for (const Case& c : cases) {
    const Expression expression(c.text, kNames);
    EXPECT_NEAR(expression.derivative(0, kAt), c.dx, 1e-14 * (1.0 + std::abs(c.dx))) << c.text;
    EXPECT_NEAR(expression.derivative(1, kAt), c.dy, 1e-14 * (1.0 + std::abs(c.dy))) << c.text;
    EXPECT_EQ(expression.derivative(2, kAt), 0.0) << c.text;
  }
}

TEST(ExpressionFunctions, DerivativesAreInfiniteWhereTheyAre) {
  EXPECT_EQ(Expression("sqrt(x)", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("x**0.5", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("asin(x)", kNames).derivative(0, {1.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("acos(x)", kNames).derivative(0, {-1.0, 0.0, 0.0, 0.0}), -HUGE_VAL);
  EXPECT_EQ(Expression("2*sqrt(-x)", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), -HUGE_VAL);
  EXPECT_EQ(Expression("log(x)", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("sqrt(x - 1) + y", kNames).derivative(1, {1.0, 0.0, 0.0, 0.0}), 1.0);
}

const std::vector<std::string> kExpressionNames = {"x", "y", "i", "e"};
const std::vector<double> kExpressionAt = {0.7, -1.3, 2.0, 5.0};

double value_at_point(const std::string& text) {
  return Expression(text, kExpressionNames).value(kExpressionAt);
}

TEST(Expression, KnowsWhatItDependsOn) {
  EXPECT_EQ(Expression("y + x*y", kExpressionNames).dependencies(), (std::vector<int>{0, 1}));
  EXPECT_EQ(Expression("e", kExpressionNames).dependencies(), (std::vector<int>{3}));
  EXPECT_TRUE(Expression("2*pi", kExpressionNames).dependencies().empty());
  EXPECT_DOUBLE_EQ(Expression("x", {"x"}).value(std::vector<double>{3.0, 4.0, 5.0}), 3.0)
      << "surplus values are for the study's own parameters";
}

TEST(Expression, HasNoValueWhereThereIsNoRealOne) {
  for (const char* text : {"sqrt(y)", "log(y)", "asin(i)", "y**0.5", "0/(x - 0.7)"})
    EXPECT_TRUE(std::isnan(value_at_point(text))) << text;
}

TEST(Expression, HasNoDerivativeWhereItHasNoValue) {
  for (const char* text : {"sqrt(y)", "log(y)", "asin(i - y)", "sqrt(y)**2", "atan2(x, log10(y))"})
    EXPECT_TRUE(std::isnan(Expression(text, kExpressionNames).derivative(1, kExpressionAt)))
        << text;
  EXPECT_TRUE(std::isnan(value_at_point("sqrt(y)**2"))) << "the root of -1.3 is no number";
}

TEST(Expression, IsTheSameFromTheValuesThatItUsesAlone) {
  const Expression expression("e*y**2 + 3*i", kExpressionNames);
  ASSERT_EQ(expression.dependencies(), (std::vector<int>{1, 2, 3}));
  const std::vector<double> used = {kExpressionAt[1], kExpressionAt[2], kExpressionAt[3]};
  EXPECT_EQ(expression.value_of(used), expression.value(kExpressionAt));
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(expression.derivative_of(k, used),
              expression.derivative(static_cast<int>(k) + 1, kExpressionAt))
        << k;
  EXPECT_EQ(expression.derivative(0, kExpressionAt), 0.0);
}

TEST(Expression, BranchesThatAreNotTakenHaveNoSay) {
  EXPECT_DOUBLE_EQ(value_at_point("x > 0 ? 2 : sqrt(y)"), 2.0);
  EXPECT_DOUBLE_EQ(value_at_point("1 + (x < 0 ? 1/0 : 5)*2"), 11.0);
  EXPECT_DOUBLE_EQ(value_at_point("max(x > 1 ? 7 : x > 0.5 ? 8 : 9, 3)"), 8.0);
}

TEST(Expression, MayBeSharedByThreads) {
  const Expression shared("x**2 + sin(y)", kExpressionNames);
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    threads.emplace_back([&, k] {
      for (int n = 0; n < 500; ++n) {
        const double x = static_cast<double>(k) + 0.001 * n, y = -x;
        const Expression own("x*y", kExpressionNames);
        const std::vector<double> at = {x, y, 0.0, 0.0};
        if (shared.value(at) != x * x + std::sin(y) || own.value(at) != x * y) ++wrong[k];
        if (std::abs(shared.derivative(0, at) - 2.0 * x) > 1e-14 * (1.0 + x)) ++wrong[k];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(wrong.size(), 0));
}

const std::vector<std::string> kTwo{"a", "b"};
const std::vector<ValueRange> kTheirRanges{{1.0, 2.0}, {-3.0, 4.0}};

ValueRange range(const std::string& text) { return Expression(text, kTwo).range(kTheirRanges); }

void expect_range(const std::string& text, double lower, double upper) {
  EXPECT_EQ(range(text).lower, lower) << text;
  EXPECT_EQ(range(text).upper, upper) << text;
}

TEST(ExpressionRange, IsThatOfTheValues) {
  expect_range("7", 7.0, 7.0);
  expect_range("a + b", -2.0, 6.0);
  expect_range("a - b", -3.0, 5.0);
  expect_range("-a", -2.0, -1.0);
  expect_range("a * b", -6.0, 8.0);
  expect_range("b * b", -12.0, 16.0);
  expect_range("b / a", -3.0, 4.0);
  expect_range("1 / a", 0.5, 1.0);
  expect_range("-2 * (a - 3)", 2.0, 4.0);
}

TEST(ExpressionRange, IsThatOfFunctionsAndConditions) {
  expect_range("sqrt(a)", 1.0, std::sqrt(2.0));
  expect_range("a ** 2", 1.0, 4.0);
  expect_range("a < b ? a : b", -3.0, 4.0);
  expect_range("b < 5 ? a : b", 1.0, 2.0);
  expect_range("1 + abs(b)", 1.0, 5.0);
  expect_range("b**2 - 1", -1.0, 15.0);
}

TEST(ExpressionRange, IsAllNumbersWhereThereMayBeNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* text : {"a / b", "sqrt(b)", "b ** 0.5", "asin(a)", "log(b)"})
    expect_range(text, -infinity, infinity);
  EXPECT_EQ(Expression("0 * a", kTwo).range({{1.0, infinity}, {}}).upper, infinity)
      << "0 * infinity is undefined";
}

/// The k-th of two independent variables.
Lanes<4> lane(double value, int k) {
  Lanes<4> x(value);
  x.v[k] = 1.0;
  return x;
}

TEST(Quantity, ConstantIsTheSameEverywhere) {
  const Quantity constant = 3.0;
  EXPECT_TRUE(constant.is_constant());
  EXPECT_EQ(constant.at(std::vector<double>{7.0}), 3.0);
  EXPECT_EQ(constant.at(std::vector<std::complex<double>>{{7.0, 1.0}}), std::complex<double>(3.0));
  const Lanes<4> lanes = constant.at(std::vector<Lanes<4>>{lane(7.0, 0)});
  EXPECT_EQ(lanes.a, 3.0);
  EXPECT_EQ(lanes.v[0], 0.0);
  EXPECT_EQ(lanes.v[1], 0.0);
}

TEST(Quantity, OnlyTheConstantZeroIsZero) {
  EXPECT_TRUE(Quantity().is_zero());
  EXPECT_TRUE(Quantity(-0.0).is_zero());
  EXPECT_FALSE(Quantity(1e-300).is_zero());
  EXPECT_FALSE(Quantity(0.0, std::make_shared<const Expression>("x", std::vector<std::string>{"x"}))
                   .is_zero());
}

TEST(Quantity, LanesCarryTheChainRule) {
  const Quantity product(
      6.0, std::make_shared<const Expression>("x*y", std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(product.nominal(), 6.0);
  std::vector<Lanes<4>> at = {lane(2.0, 0), lane(5.0, 1)};
  at[0].v = 10.0 * at[0].v;  // the parameter itself has a derivative
  const Lanes<4> value = product.at(at);
  EXPECT_DOUBLE_EQ(value.a, 10.0);
  EXPECT_DOUBLE_EQ(value.v[0], 50.0);
  EXPECT_DOUBLE_EQ(value.v[1], 2.0);
}

TEST(Quantity, ComplexStepGoesThrough) {
  const Quantity square(4.0,
                        std::make_shared<const Expression>("x**2", std::vector<std::string>{"x"}));
  const std::complex<double> value = square.at(std::vector<std::complex<double>>{{3.0, 1e-20}});
  EXPECT_DOUBLE_EQ(value.real(), 9.0);
  EXPECT_DOUBLE_EQ(value.imag(), 6e-20);
}

}  // namespace

}  // namespace codesign
