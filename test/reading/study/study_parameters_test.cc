// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <gtest/gtest.h>
#include <cmath>

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

Study with_parameters(const std::string& parameters) {
  return read_text(kLeastStudy + "parameters: " + parameters + "\n");
}

void expect_bad_parameters(const std::string& parameters, const std::string& element,
                           const std::string& message) {
  expect_fault(kLeastStudy + "parameters: " + parameters + "\n", element, message, 3);
}

TEST(StudyParameters, BoundsAndStartDefaultToTheModels) {
  const Parameter parameter = with_parameters("{crank_length: {}}").parameters.at(0);
  EXPECT_EQ(parameter.value, 0.08);
  EXPECT_EQ(parameter.lower, 0.06);
  EXPECT_EQ(parameter.upper, 0.1);
  EXPECT_EQ(parameter.unit, "m");
}

TEST(StudyParameters, TheStudyMayMoveBoundsAndStart) {
  const Parameter parameter =
      with_parameters("{crank_length: {initial: 0.11, lower: 0.05, upper: 0.12}}").parameters.at(0);
  EXPECT_EQ(parameter.value, 0.11);
  EXPECT_EQ(parameter.lower, 0.05);
  EXPECT_EQ(parameter.upper, 0.12);
}

TEST(StudyParameters, AListedOneIsTunedUnlessItSaysOtherwise) {
  const Study study = with_parameters(
      "{rod_length: {tune: true}, crank_length: {initial: 0.07, tune: false}, Kp: {initial: 2, "
      "tune: false}}");
  EXPECT_EQ(study.tuned, std::vector<int>{1});
  EXPECT_EQ(study.parameters[0].value, 0.07);
  EXPECT_EQ(study.parameters.at(2).value, 2.0);
}

TEST(StudyParameters, AStudysOwnFollowTheModelsAndMayBeUnbounded) {
  const Study study =
      with_parameters("{Kp: {initial: 750}, rod_length: {}, Ki: {initial: 2, lower: 0}}");
  ASSERT_EQ(study.parameters.size(), 4U);
  EXPECT_EQ(study.tuned, (std::vector<int>{2, 1, 3}));
  EXPECT_EQ(study.parameters[2].name, "Kp");
  EXPECT_EQ(study.parameters[2].value, 750.0);
  EXPECT_EQ(study.parameters[2].unit, "");
  EXPECT_TRUE(std::isinf(study.parameters[2].lower) && study.parameters[2].lower < 0.0);
  EXPECT_EQ(study.parameters[3].lower, 0.0);
  EXPECT_TRUE(std::isinf(study.parameters[3].upper));
}

TEST(StudyParameters, RefusesBadRanges) {
  expect_bad_parameters("{crank_length: {lower: 0.2}}", "parameters.crank_length.lower",
                        "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 1, lower: 2, upper: 1}}", "parameters.Kp.lower",
                        "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 1, lower: 1, upper: 1}}", "parameters.Kp.lower",
                        "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 9, lower: -5, upper: 5}}", "parameters.Kp.initial",
                        "outside the bounds");
  expect_bad_parameters("{crank_length: {lower: 0.09}}", "parameters.crank_length",
                        "outside the bounds");
  EXPECT_EQ(fault_in(kLeastStudy + "parameters: {Kp: {initial: 9, lower: -5, upper: 5}}").allowed,
            "[-5, 5]");
}

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
  const FittedNumber empty = fitted_number("{}", -3.0, 1.0),
                     full = fitted_number("{initial: 0.5, lower: 0, upper: 2}", -3.0, 1.0);
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

double margin(const Study& study, std::size_t k, double crank, double rod) {
  return study.constraints.at(k).margin->value(std::vector<double>{crank, rod});
}

TEST(StudyConstraints, MayUseTheStudysOwnParameters) {
  const Study study = read_text(
      kLeastStudy + "parameters: {Kp: {initial: 1}}\nconstraints: [\"Kp >= 10*rod_length\"]\n");
  EXPECT_DOUBLE_EQ(study.constraints.at(0).margin->value(std::vector<double>{0.08, 0.3, 5.0}), 2.0);
  EXPECT_EQ(study.constraints[0].where.line, 4);
}

TEST(StudyConstraints, BoundSumsOfParameters) {
  const Study study = read_text(
      kLeastStudy +
      "constraints:\n"
      "  - \"rod_length - crank_length >= 0.165\"\n"
      "  - {expression: \"${crank_length + rod_length}\", between: [0.3, \"${5*crank_length}\"]}\n"
      "  - {expression: \"${2*rod_length}\", at_most: 0.7}\n");
  ASSERT_EQ(study.constraints.size(), 4U);
  EXPECT_EQ(study.constraints[1].text, "crank_length + rod_length >= 0.3");
  EXPECT_EQ(study.constraints[2].text, "crank_length + rod_length <= 5*crank_length");
  EXPECT_EQ(study.constraints[3].text, "2*rod_length <= 0.7");
  EXPECT_EQ(study.constraints[2].element, "constraints[1]");
  EXPECT_EQ(study.constraints[3].element, "constraints[2]");
  EXPECT_EQ(study.constraints[3].where.line, 6);
  EXPECT_NEAR(margin(study, 1, 0.1, 0.25), 0.05, 1e-15);
  EXPECT_NEAR(margin(study, 2, 0.1, 0.25), 0.15, 1e-15);
  EXPECT_NEAR(margin(study, 3, 0.1, 0.25), 0.2, 1e-15);
  EXPECT_EQ(study.used_parameters.count(0), 0U) << "a constraint moves nothing";
}

}  // namespace
}  // namespace codesign
