// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_fitted_number.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

FittedNumber fitted_number(const std::string& text, double lower, double standard) {
  FittedNumber number(standard);
  read_fitted(YamlValue::parse({"study.yaml", "x: " + text + "\n"}).at("x"), lower, &number);
  return number;
}

TEST(StudyFittedNumber, ANumberIsKnown) {
  const FittedNumber number = fitted_number("2.5", 0.0, 1.0);
  EXPECT_FALSE(number.is_fitted);
  EXPECT_EQ(number.value, 2.5);
  EXPECT_EQ(number.where.line, 1);
}

TEST(StudyFittedNumber, AMapIsFitted) {
  const FittedNumber empty = fitted_number("{}", -3.0, 1.0), full = fitted_number("{initial: 0.5, lower: 0, upper: 2}", -3.0, 1.0);
  EXPECT_TRUE(empty.is_fitted);
  EXPECT_EQ(empty.value, 1.0);
  EXPECT_EQ(empty.lower, -3.0);
  EXPECT_TRUE(std::isinf(empty.upper));
  EXPECT_EQ(full.value, 0.5);
  EXPECT_EQ(full.lower, 0.0);
  EXPECT_EQ(full.upper, 2.0);
}

TEST(StudyFittedNumber, RefusesOtherKeysAndBounds) {
  EXPECT_THROW(fitted_number("{initial: 1, least: 0}", 0.0, 1.0), InputError);
  EXPECT_THROW(fitted_number("{initial: 5, upper: 2}", 0.0, 1.0), InputError);
  EXPECT_THROW(fitted_number("much", 0.0, 1.0), InputError);
}

}  // namespace
}  // namespace codesign
