// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_parameters.h"

#include <cmath>

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

Study with_parameters(const std::string& parameters) { return read_text(kLeastStudy + "parameters: " + parameters + "\n"); }

void expect_bad_parameters(const std::string& parameters, const std::string& element, const std::string& message) {
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
  const Parameter parameter = with_parameters("{crank_length: {initial: 0.11, lower: 0.05, upper: 0.12}}").parameters.at(0);
  EXPECT_EQ(parameter.value, 0.11);
  EXPECT_EQ(parameter.lower, 0.05);
  EXPECT_EQ(parameter.upper, 0.12);
}

TEST(StudyParameters, AListedOneIsTunedUnlessItSaysOtherwise) {
  const Study study =
      with_parameters("{rod_length: {tune: true}, crank_length: {initial: 0.07, tune: false}, Kp: {initial: 2, tune: false}}");
  EXPECT_EQ(study.tuned, std::vector<int>{1});
  EXPECT_EQ(study.parameters[0].value, 0.07);
  EXPECT_EQ(study.parameters.at(2).value, 2.0);
}

TEST(StudyParameters, AStudysOwnFollowTheModelsAndMayBeUnbounded) {
  const Study study = with_parameters("{Kp: {initial: 750}, rod_length: {}, Ki: {initial: 2, lower: 0}}");
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
  expect_bad_parameters("{crank_length: {lower: 0.2}}", "parameters.crank_length.lower", "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 1, lower: 2, upper: 1}}", "parameters.Kp.lower", "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 1, lower: 1, upper: 1}}", "parameters.Kp.lower", "below the upper bound");
  expect_bad_parameters("{Kp: {initial: 9, lower: -5, upper: 5}}", "parameters.Kp.initial", "outside the bounds");
  expect_bad_parameters("{crank_length: {lower: 0.09}}", "parameters.crank_length", "outside the bounds");
  EXPECT_EQ(fault_in(kLeastStudy + "parameters: {Kp: {initial: 9, lower: -5, upper: 5}}").allowed, "[-5, 5]");
}

TEST(StudyParameters, RefusesBadEntries) {
  expect_bad_parameters("{crank_lenght: {}}", "parameters.crank_lenght.initial", "did you mean \"crank_length\"");
  expect_bad_parameters("{Kp: {start: 1}}", "parameters.Kp.start", "unknown key");
  expect_bad_parameters("{2Kp: {initial: 1}}", "parameters.2Kp", "");
  expect_bad_parameters("{sqrt: {initial: 1}}", "parameters.sqrt", "");
  expect_bad_parameters("{crank_length: {tune: maybe}}", "parameters.crank_length.tune", "not a truth value");
  expect_bad_parameters("{crank_length: {tune: [true]}}", "parameters.crank_length.tune", "not a truth value");
  expect_bad_parameters("{Kp: 1}", "parameters.Kp", "expected a map");
  expect_bad_parameters("{Kp: {initial: .inf}}", "parameters.Kp.initial", "not finite");
  expect_bad_parameters("{Kp: {initial: \"${rod_length}\"}}", "parameters.Kp.initial", "not a number");
  expect_bad_parameters("{rod_length: {}, rod_length: {}}", "parameters.rod_length", "repeated key");
  expect_bad_parameters("[crank_length]", "parameters", "expected a map");
}

}  // namespace
}  // namespace codesign
