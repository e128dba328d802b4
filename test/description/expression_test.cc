// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <thread>

namespace codesign {
namespace {

const std::vector<std::string> kExpressionNames = {"x", "y", "i", "e"};
const std::vector<double> kExpressionAt = {0.7, -1.3, 2.0, 5.0};

double value_at_point(const std::string& text) { return Expression(text, kExpressionNames).value(kExpressionAt); }

TEST(Expression, KnowsWhatItDependsOn) {
  EXPECT_EQ(Expression("y + x*y", kExpressionNames).dependencies(), (std::vector<int>{0, 1}));
  EXPECT_EQ(Expression("e", kExpressionNames).dependencies(), (std::vector<int>{3}));
  EXPECT_TRUE(Expression("2*pi", kExpressionNames).dependencies().empty());
  EXPECT_DOUBLE_EQ(Expression("x", {"x"}).value(std::vector<double>{3.0, 4.0, 5.0}), 3.0)
      << "surplus values are for the study's own parameters";
}

TEST(Expression, HasNoValueWhereThereIsNoRealOne) {
  for (const char* text : {"sqrt(y)", "log(y)", "asin(i)", "y**0.5", "0/(x - 0.7)"}) EXPECT_TRUE(std::isnan(value_at_point(text))) << text;
}

TEST(Expression, IsTheSameFromTheValuesThatItUsesAlone) {
  const Expression expression("e*y**2 + 3*i", kExpressionNames);
  ASSERT_EQ(expression.dependencies(), (std::vector<int>{1, 2, 3}));
  const std::vector<double> used = {kExpressionAt[1], kExpressionAt[2], kExpressionAt[3]};
  EXPECT_EQ(expression.value_of(used), expression.value(kExpressionAt));
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(expression.derivative_of(k, used), expression.derivative(static_cast<int>(k) + 1, kExpressionAt)) << k;
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

}  // namespace
}  // namespace codesign
