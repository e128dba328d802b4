// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "model/expression_syntax.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mechanism_codesign/model/expression.h"

namespace codesign {
namespace {

const std::vector<std::string> kNames = {"x", "y", "i", "e"};
const std::vector<double> kAt = {0.7, -1.3, 2.0, 5.0};

std::string complaint(const std::string& text) {
  try {
    Expression(text, kNames).value(kAt);
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
    EXPECT_STREQ(error.what(), "unknown name 'crank_lenght', did you mean 'crank_length'? at position 3 of '2*crank_lenght'");
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
  expect_complaint("x y", "Unexpected");
  expect_complaint("x*", "Unexpected");
  expect_complaint("1, 2", "comma");
  expect_complaint("x < 1", "a comparison is not a number");
  expect_complaint("(x < 1) + 2", "");
  expect_complaint("min(x < 1, 2)", "a comparison stands where a number is needed");
  expect_complaint("x ? 1 : 2", "");
  expect_complaint("sqrt()", "");
  expect_complaint("atan2(x)", "");
}

TEST(ExpressionSyntax, SaysWhichNamesParametersCannotHave) {
  for (const char* name : {"crank_length", "Kp", "_a1", "i", "e"}) EXPECT_EQ(identifier_fault(name), "") << name;
  for (const char* name : {"", "2x", "a-b", "a b", "pi", "sin", "l\xC3\xA4nge"}) EXPECT_NE(identifier_fault(name), "") << name;
}

}  // namespace
}  // namespace codesign
