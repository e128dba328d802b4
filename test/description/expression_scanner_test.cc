// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_scanner.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace codesign {
namespace {

std::vector<std::string> tokens_of(const std::string& text) {
  const ExpressionScope scope;
  std::vector<std::string> tokens;
  for (ExpressionScanner scanner(text, scope); scanner.token().kind != ExpressionToken::Kind::kEnd;
       scanner.next())
    tokens.push_back(scanner.token().text);
  return tokens;
}

TEST(ExpressionScanner, SplitsAtOperatorsAndBlanks) {
  EXPECT_EQ(tokens_of("2.5e-3*a_1 **(b<=c)"),
            (std::vector<std::string>{"2.5e-3", "*", "a_1", "**", "(", "b", "<=", "c", ")"}));
  EXPECT_EQ(tokens_of(" \n"), std::vector<std::string>());
}

// Words are names: `and` begins no other token than `android`.
TEST(ExpressionScanner, KnowsWordsByTheirWholeText) {
  const ExpressionScope scope;
  const std::string text = "and android not";
  ExpressionScanner scanner(text, scope);
  EXPECT_TRUE(scanner.is_word("and"));
  scanner.next();
  EXPECT_FALSE(scanner.is_word("and"));
  EXPECT_EQ(scanner.token().at, 4U);
  scanner.next();
  EXPECT_TRUE(scanner.is_word("not"));
  EXPECT_FALSE(scanner.is("not"));
}

}  // namespace
}  // namespace codesign
