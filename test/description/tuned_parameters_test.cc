// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <limits>

#include "description/study.h"
#include "description/tuned_parameters.h"

namespace codesign {
namespace {

const std::vector<std::string> kLengths = {"crank_length", "rod_length"};

double margin(const std::string& text, double crank, double rod) {
  return parse_constraint(text, kLengths, {"study.yaml", 4}, "constraints[0]")
      .margin->value(std::vector<double>{crank, rod});
}

TEST(ParameterConstraint, MarginIsWhatIsLeftBeforeTheLimit) {
  EXPECT_DOUBLE_EQ(margin("rod_length - crank_length >= 0.165", 0.08, 0.3), 0.3 - 0.08 - 0.165);
  EXPECT_DOUBLE_EQ(margin("rod_length - crank_length <= 0.165", 0.08, 0.3), 0.165 - (0.3 - 0.08));
  EXPECT_DOUBLE_EQ(margin("0.1 >= crank_length - 0.02", 0.08, 0.3), 0.1 - 0.06);
}

TEST(ParameterConstraint, MayBeAnEquality) {
  const auto parse = [](const char* text) {
    return parse_constraint(text, kLengths, {"study.yaml", 4}, "constraints[0]");
  };
  EXPECT_TRUE(parse("rod_length == 3*crank_length").is_equality);
  EXPECT_FALSE(parse("rod_length >= 3*crank_length").is_equality);
  EXPECT_FALSE(parse("(crank_length == 0.05 ? rod_length : 0) <= 0.25").is_equality);
  EXPECT_DOUBLE_EQ(margin("rod_length == 3*crank_length", 0.08, 0.3), 0.24 - 0.3);
}

TEST(ParameterConstraint, KeepsItsText) {
  EXPECT_EQ(parse_constraint("rod_length >= 0.1", kLengths, {"s", 1}, "constraints[0]").text,
            "rod_length >= 0.1");
}

TEST(ParameterConstraint, LeavesComparisonsInParenthesesToTheExpression) {
  EXPECT_DOUBLE_EQ(margin("(crank_length >= 0.05 ? rod_length : 0) >= 0.25", 0.08, 0.3), 0.05);
}

TEST(ParameterConstraint, IsMadeOfTwoSides) {
  const ParameterConstraint made = make_constraint("short", "crank_length + 0.1", "rod_length",
                                                   kLengths, {"s", 2}, "constraints[3]");
  EXPECT_EQ(made.text, "short");
  EXPECT_EQ(made.element, "constraints[3]");
  EXPECT_DOUBLE_EQ(made.margin->value(std::vector<double>{0.1, 0.5}), 0.3);
  EXPECT_THROW(
      make_constraint("open", "(crank_length", "rod_length)", kLengths, {"s", 2}, "constraints[3]"),
      std::invalid_argument);
}

void expect_bad_constraint(const std::string& text, const std::string& reason) {
  try {
    parse_constraint(text, kLengths, {"study.yaml", 4}, "constraints[0]");
    ADD_FAILURE() << text;
  } catch (const InputError& error) {
    EXPECT_NE(error.fault().message.find(reason), std::string::npos) << error.what();
    EXPECT_EQ(error.fault().value, text);
    EXPECT_EQ(error.fault().where.line, 4);
    EXPECT_EQ(error.fault().element, "constraints[0]");
  }
}

TEST(ParameterConstraint, RefusesWhatIsNone) {
  expect_bad_constraint("rod_length - crank_length", "exactly one");
  expect_bad_constraint("rod_length > crank_length", "exactly one");
  expect_bad_constraint("0.1 <= rod_length <= 0.2", "exactly one");
  expect_bad_constraint("0.1 == rod_length == crank_length", "exactly one");
  expect_bad_constraint("rod_length = 0.2", "exactly one");
  expect_bad_constraint("rod_lenght >= 0.2", "rod_length");
  expect_bad_constraint("rod_length >= ", "");
  expect_bad_constraint("(rod_length) - ( >= 0.2)", "");
  expect_bad_constraint("1 >= 0", "no parameter");
}

TEST(TunedParameters, StandInTheOrderOfTheStudy) {
  Study study;
  for (const auto& [name, value] : {std::pair{"a", 1.0}, {"b", 2.0}, {"c", 3.0}}) {
    Parameter& parameter = study.parameters.emplace_back();
    parameter.name = name;
    parameter.value = value;
  }
  study.tuned = {2, 0};
  EXPECT_EQ(start_parameters(study), (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(start_of(study), Eigen::Vector2d(3.0, 1.0));
  EXPECT_EQ(tuned_names(study), (std::vector<std::string>{"c", "a"}));
  EXPECT_EQ(parameters_at(study, Eigen::Vector2d(30.0, 10.0)),
            (std::vector<double>{10.0, 2.0, 30.0}));
  EXPECT_EQ(tuned_parameter(study, 0).name, "c");
  EXPECT_EQ(tuned_parameter(study, 1).name, "a");
}

TEST(TunedParameters, AreRequiredForASearch) {
  Study study;
  study.file = "study.yaml";
  EXPECT_THROW(require_tuned(study), InputError);
  study.parameters.emplace_back();
  study.tuned = {0};
  EXPECT_NO_THROW(require_tuned(study));
}

TEST(TunedParameters, NeedTwoFiniteBoundsForManyStarts) {
  Parameter parameter;
  parameter.name = "rod";
  parameter.lower = 0.2;
  parameter.upper = 0.4;
  EXPECT_EQ(range_of(parameter), "[0.2, 0.4]");
  EXPECT_FALSE(find_missing_bounds(parameter));
  parameter.upper = std::numeric_limits<double>::infinity();
  const auto fault = find_missing_bounds(parameter);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->element, "parameter rod");
}

}  // namespace

}  // namespace codesign
