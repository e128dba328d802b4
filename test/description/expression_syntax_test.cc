// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_syntax.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "description/expression.h"

namespace codesign {
namespace {

const std::vector<std::string> kSyntaxNames = {"x", "y", "i", "e"};
const std::vector<double> kSyntaxAt = {0.7, -1.3, 2.0, 5.0};

std::string complaint(const std::string& text) {
  try {
    Expression(text, kSyntaxNames).value(kSyntaxAt);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

void expect_complaint(const std::string& text, const std::string& part) {
  EXPECT_NE(complaint(text).find(part), std::string::npos) << complaint(text);
}

TEST(ExpressionSyntax, ComplaintsNameThePlaceAndTheNearestName) {
  const std::vector<std::string> names = {"crank_length"};
  try {
    Expression("2*crank_lenght", names);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "unknown name 'crank_lenght', did you mean 'crank_length'? at position 3 of "
                 "'2*crank_lenght'");
  }
  expect_complaint("sqr(x)", "did you mean 'sqrt'?");
  expect_complaint("q", "unknown name 'q'");
  expect_complaint("system(x)", "unknown function 'system'");
  expect_complaint("sin*2", "lacks its parentheses");
}

TEST(ExpressionSyntax, RefusesWhatIsNoArithmetic) {
  expect_complaint("", "empty");
  expect_complaint("  ", "empty");
  expect_complaint("x = 2", "unexpected '='");
  expect_complaint("'text'", "unexpected character '''");
  expect_complaint("{1, 2}", "unexpected character '{'");
  expect_complaint("x[0]", "unexpected character '['");
  expect_complaint("3k", "malformed number");
  expect_complaint("1.2.3", "malformed number");
  expect_complaint("0x10", "malformed number");
  expect_complaint("(x", "parenthesis");
  expect_complaint("x)", "parenthesis");
  expect_complaint("x y", "an operator is missing before 'y' at position 3");
  expect_complaint("x*", "a number is missing at position 3");
  expect_complaint("2(x)", "an operator is missing before '(' at position 2");
  expect_complaint("x*/y", "a number is missing before '/' at position 3");
  expect_complaint("1e999", "too large or too small");
  expect_complaint("1, 2", "comma");
  expect_complaint("x < 1", "a comparison is not a number");
  expect_complaint("(x < 1) + 2", "");
  expect_complaint("min(x < 1, 2)", "a comparison stands where a number is needed");
  expect_complaint("x ? 1 : 2", "");
  expect_complaint("sqrt()", "");
  expect_complaint("atan2(x)", "");
}

// A previous parser accepted these and gave them another meaning.
TEST(ExpressionSyntax, RefusesWhatLooksLikeSomethingElse) {
  expect_complaint("99\n3", "an operator is missing before '3' at position 4");
  expect_complaint("1\r\n+ 2\n3", "an operator is missing before '3'");
  expect_complaint("(1>0 ? 2) : 3",
                   "expected a ':' that belongs to its '?', found ')' at position 9");
  expect_complaint("min(1>0 ? 2, 3 : 4)",
                   "expected a ':' that belongs to its '?', found ',' at position 12");
  expect_complaint("1 : 2", "a ':' without its '?'");
  expect_complaint("1>0 ? 2", "expected a ':'");
  expect_complaint("1<2<3", "a comparison stands where a number is needed at position 4");
  expect_complaint("x ? 1 : 2", "a number stands before '?'");
  expect_complaint("min(1, 2",
                   "expected a comma or a closing parenthesis, found the end at position 9");
  expect_complaint("atan2(x)", "takes 2 arguments, not 1");
  expect_complaint("sqrt(x, y)", "takes 1 argument, not 2");
  EXPECT_DOUBLE_EQ(Expression("x\n+\ny", kSyntaxNames).value(kSyntaxAt), 0.7 - 1.3)
      << "a line break is white space like any other";
}

// not before and before or, as in Python; x = 0.7, y = -1.3.
TEST(ExpressionSyntax, JoinsComparisons) {
  const auto holds = [](const std::string& text) {
    return Expression(text + " ? 1 : 0", kSyntaxNames).value(kSyntaxAt) == 1.0;
  };
  EXPECT_TRUE(holds("x > 0 and y < 0"));
  EXPECT_FALSE(holds("x > 0 and y > 0"));
  EXPECT_FALSE(holds("x < 0 and y < 0"));
  EXPECT_TRUE(holds("x > 0 or y > 0"));
  EXPECT_TRUE(holds("x < 0 or y < 0"));
  EXPECT_FALSE(holds("x < 0 or y > 0"));
  EXPECT_TRUE(holds("x < 0 or y > 0 or i == 2"));
  EXPECT_TRUE(holds("not x < 0"));
  EXPECT_FALSE(holds("not not x < 0"));
  EXPECT_TRUE(holds("x > 0 or y < 0 and x < 0"));
  EXPECT_FALSE(holds("(x > 0 or y < 0) and x < 0"));
  EXPECT_TRUE(holds("not x < 0 and not y > 0"));
  EXPECT_TRUE(holds("not (x > 0 and y > 0)"));
  EXPECT_EQ(Expression("2*(1 < 2 and 2 < 3 ? x : y)", kSyntaxNames).value(kSyntaxAt), 1.4);
  expect_complaint("x and y > 0 ? 1 : 2", "where a comparison is needed at position 1");
  expect_complaint("x > 0 and y ? 1 : 2", "where a comparison is needed at position 11");
  expect_complaint("x > 0 or y ? 1 : 2", "where a comparison is needed at position 10");
  expect_complaint("not x ? 1 : 2", "where a comparison is needed at position 5");
  expect_complaint("x > 0 and y > 0", "a comparison is not a number");
  expect_complaint("2*(x > 0 or y > 0)", "a comparison stands where a number is needed");
}

TEST(ExpressionSyntax, EndsWhateverItsSize) {
  expect_complaint(std::string(500000, '(') + "1", "nested too deeply");
  expect_complaint("1" + std::string(500000, '^'), "a number is missing");
  std::string powers = "1", conditions;
  for (int k = 0; k < 100000; ++k) {
    powers += "^1";
    conditions += "1<2?1:";
  }
  expect_complaint(powers, "nested too deeply");
  expect_complaint(conditions + "1", "nested too deeply");
  EXPECT_LT(complaint(std::string(1000000, 'q')).size(), 400U) << "a message is for people";
  std::string sum = "0";
  for (int k = 0; k < 250000; ++k) sum += "+1";
  EXPECT_DOUBLE_EQ(Expression(sum, kSyntaxNames).value(kSyntaxAt), 250000.0);
  EXPECT_DOUBLE_EQ(Expression(std::string(1000001, '-') + "1", kSyntaxNames).value(kSyntaxAt),
                   -1.0);
}

TEST(ExpressionSyntax, SaysWhichNamesParametersCannotHave) {
  for (const char* name : {"crank_length", "Kp", "_a1", "i", "e"})
    EXPECT_EQ(identifier_fault(name), "") << name;
  for (const char* name : {"", "2x", "a-b", "a b", "pi", "sin", "and", "or", "not", "l\xC3\xA4nge"})
    EXPECT_NE(identifier_fault(name), "") << name;
}

}  // namespace
}  // namespace codesign
