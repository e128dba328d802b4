// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/traced.h"
#include "description/scalar_agreement.h"

namespace codesign {
namespace {

const std::vector<std::string> kVariables{"x", "y"};

double value_of_text(const std::string& text, double x, double y) {
  return Expression(text, kVariables).value(std::vector<double>{x, y});
}

struct Case {
  const char* text;
  double (*value)(double x, double y);
};
const std::vector<Case> kCases = {
    {"sqrt(x)", [](double x, double) { return std::sqrt(x); }},
    {"sin(x)", [](double x, double) { return std::sin(x); }},
    {"cos(x)", [](double x, double) { return std::cos(x); }},
    {"tan(x)", [](double x, double) { return std::tan(x); }},
    {"asin(x)", [](double x, double) { return std::asin(x); }},
    {"acos(x)", [](double x, double) { return std::acos(x); }},
    {"atan(x)", [](double x, double) { return std::atan(x); }},
    {"atan2(x, y)", [](double x, double y) { return std::atan2(x, y); }},
    {"sinh(x)", [](double x, double) { return std::sinh(x); }},
    {"cosh(x)", [](double x, double) { return std::cosh(x); }},
    {"tanh(x)", [](double x, double) { return std::tanh(x); }},
    {"exp(x)", [](double x, double) { return std::exp(x); }},
    {"log(x)", [](double x, double) { return std::log(x); }},
    {"log10(x)", [](double x, double) { return std::log10(x); }},
    {"pow(x, y)", [](double x, double y) { return std::pow(x, y); }},
    {"abs(x - 0.5)", [](double x, double) { return std::abs(x - 0.5); }},
    {"sign(x - 0.5)", [](double x, double) { return x < 0.5 ? -1.0 : 1.0; }},
    {"min(x, y)", [](double x, double y) { return std::min(x, y); }},
    {"max(x, y)", [](double x, double y) { return std::max(x, y); }},
    {"floor(3*y)", [](double, double y) { return std::floor(3.0 * y); }},
    {"ceil(3*y)", [](double, double y) { return std::ceil(3.0 * y); }},
    {"radians(x)", [](double x, double) { return x * (M_PI / 180.0); }},
    {"degrees(x)", [](double x, double) { return x * (180.0 / M_PI); }},
    {"x + y", [](double x, double y) { return x + y; }},
    {"x - y", [](double x, double y) { return x - y; }},
    {"x*y", [](double x, double y) { return x * y; }},
    {"x/y", [](double x, double y) { return x / y; }},
    {"-x", [](double x, double) { return -x; }},
    {"x**y", [](double x, double y) { return std::pow(x, y); }},
    {"y^3", [](double, double y) { return std::pow(y, 3.0); }},
    {"y**(1 - 3)", [](double, double y) { return std::pow(y, -2.0); }},
    {"x < 0.5 ? x : y", [](double x, double y) { return x < 0.5 ? x : y; }},
};

// The values to the last bit, and the derivatives against differences.
TEST(Formula, EveryFunctionAndOperatorIsThatOfTheLibraryForEveryScalar) {
  for (const Case& one : kCases)
    for (const double x : {0.3, 0.8})
      for (const double y : {0.7, -1.6}) {
        const double h = 1e-6;
        EXPECT_EQ(value_of_text(one.text, x, y), one.value(x, y)) << one.text;
        EXPECT_NEAR(Expression(one.text, kVariables).derivative(0, {x, y}),
                    (one.value(x + h, y) - one.value(x - h, y)) / (2.0 * h), 1e-7)
            << one.text;
        EXPECT_EQ(scalar_disagreement(one.text, kVariables, {x, y}), "");
      }
  for (const ExpressionFunction& function : expression_function_table())
    EXPECT_TRUE(std::any_of(kCases.begin(), kCases.end(), [&](const Case& one) {
      return std::string(one.text).rfind(std::string(function.name) + "(", 0) == 0;
    })) << function.name;
}

TEST(Formula, AllScalarsAgreeOnRandomExpressions) {
  std::mt19937_64 engine(7);
  const auto below = [&engine](std::size_t count) { return engine() % count; };
  for (int k = 0; k < 400; ++k) {
    const double x = 0.001 * static_cast<double>(below(4000)) - 2.0003,
                 y = 0.001 * static_cast<double>(below(4000)) - 2.0007;
    ASSERT_EQ(scalar_disagreement(random_formula(kVariables, 1 + k % 3, below), kVariables, {x, y}),
              "")
        << x << " " << y;
  }
}

TEST(Formula, DecidesOnBothSidesOfEveryComparison) {
  struct Comparison {
    const char* sign;
    double below, same, above;
  };
  for (const Comparison& one : {Comparison{"<", 1, 2, 2},
                                {"<=", 1, 1, 2},
                                {">", 2, 2, 1},
                                {">=", 2, 1, 1},
                                {"==", 2, 1, 2},
                                {"!=", 1, 2, 1}}) {
    const std::string text = std::string("x ") + one.sign + " y ? 1 : 2";
    for (const auto& [x, expected] :
         {std::pair(-1.0, one.below), {0.5, one.same}, {2.0, one.above}}) {
      EXPECT_EQ(value_of_text(text, x, 0.5), expected) << text << " " << x;
      EXPECT_EQ(recorded_value<double>(Expression(text, kVariables), {x, 0.5}, {false, false}),
                expected)
          << text << " " << x;
    }
  }
  EXPECT_EQ(value_of_text("sign(x)", 0.0, 0.0), 0.0);
  for (const double x : {2.0, -1.4, 2.5, 3.5, -2.5, -0.3}) {
    EXPECT_EQ(value_of_text("floor(x)", x, 0.0), std::floor(x));
    EXPECT_EQ(value_of_text("ceil(x)", x, 0.0), std::ceil(x));
  }
}

// However the whole exponent is written: t2.yaml and p.yaml of a mechanism that was called
// singular.
TEST(Formula, AWholePowerOfANegativeNumberIsExact) {
  for (const char* text :
       {"(x - 1)**2", "(x - 1)**(1+1)", "(x - 1)**(6/3)", "(x - 1)**(2*1)", "(x - 1)^floor(2.5)",
        "(x - 1)**(1 < 2 ? 2 : 3)", "pow(x - 1, -2 + 4)"}) {
    const Expression expression(text, kVariables);
    EXPECT_EQ(expression.value(std::vector<double>{0.25, 0.0}), 0.5625) << text;
    const Taylor<double> series = time_series<double>(expression, 0, {0.0}, 0.25);
    EXPECT_EQ(series.c[0], 0.5625) << text;
    EXPECT_DOUBLE_EQ(series.c[1], -1.5) << text;
    EXPECT_DOUBLE_EQ(series.c[2], 1.0) << text;
    EXPECT_EQ(series.c[3], 0.0) << text;
    EXPECT_EQ(recorded_value<double>(expression, {0.25}, {false}), 0.5625) << text;
  }
  const Expression power("x**y", kVariables);
  EXPECT_EQ(power.value(std::vector<double>{-2.0, 3.0}), -8.0);
  EXPECT_EQ(power.derivative(0, {-2.0, 3.0}), 12.0);
  EXPECT_TRUE(std::isnan(power.derivative(1, {-2.0, 3.0}))) << "beside 3 there is no value";
  EXPECT_EQ(time_series<double>(power, 7, {-2.0, 3.0}, 0.1).c[0], -8.0);
  EXPECT_TRUE(std::isnan(value_of_text("x**y", -2.0, 2.5)));
}

TEST(Formula, AnOperationAmongConstantsIsAConstant) {
  EXPECT_EQ(Expression("x**(1+1)", kVariables).steps().size(), 3U);
  EXPECT_EQ(Expression("-(2 + 3)*max(1, sin(pi/2), 0)", kVariables).steps().size(), 1U);
  EXPECT_EQ(value_of_text("(x < 1 ? 1 : 2) + 3", 0.0, 0.0), 4.0) << "the 2 is no operand";
  EXPECT_EQ(value_of_text("(x < 1 ? 1 : 2) + 3", 2.0, 0.0), 5.0);
  EXPECT_EQ(value_of_text("-(x < 1 ? 1 : 2)", 0.0, 0.0), -1.0);
  EXPECT_EQ(value_of_text("x < 1 ? -(1 + 1) : 2*3", 0.0, 0.0), -2.0);
  EXPECT_EQ(value_of_text("x < 1 ? -(1 + 1) : 2*3", 2.0, 0.0), 6.0);
}

TEST(Formula, IsRecorded) {
  Recording recording;
  const std::vector<Traced> variables{Traced(&recording, recording.leaf(0, 0, true)),
                                      Traced(&recording, recording.leaf(0, 1, true))};
  const Expression expression("max(x, y)*x^2", kVariables);
  const Traced result = evaluate_formula<Traced>(expression.steps(), variables);
  EXPECT_FALSE(result.is_literal());
  EXPECT_FALSE(recording.refused());
  EXPECT_EQ(recording.guards().size(), 1U);
}

}  // namespace
}  // namespace codesign
