// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <cmath>

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

// Lines 1 to 3; `uncertain:` begins in line 4.
const std::string kCertainStudy = kLeastStudy +
                                  "parameters: {Kp: {initial: 1.0}, free: {initial: 2.0, tune: "
                                  "false}, mass: {initial: 1, lower: 0, upper: 5, tune: false}}\n";

std::vector<UncertainQuantity> uncertain_of(const std::string& text) {
  return read_text(kCertainStudy + "uncertain: " + text + "\n").ensemble.uncertain;
}

void expect_bad_uncertain(const std::string& text, const std::string& element,
                          const std::string& message, int line = 4) {
  expect_fault(kCertainStudy + "uncertain: " + text + "\n", element, message, line);
}

std::string allowed_by(const std::string& text) {
  return fault_in(kCertainStudy + "uncertain: " + text).allowed;
}

TEST(StudyUncertain, ReadsAUniformDistribution) {
  const UncertainQuantity quantity = uncertain_of("\n  mass: {uniform: [0.0, 4.5]}").at(0);
  EXPECT_EQ(quantity.name, "mass");
  EXPECT_EQ(quantity.parameter, 4);
  EXPECT_EQ(quantity.distribution.kind, DistributionKind::kUniform);
  EXPECT_EQ(quantity.distribution.lower, 0.0);
  EXPECT_EQ(quantity.distribution.upper, 4.5);
  EXPECT_TRUE(quantity.laws.empty());
  EXPECT_EQ(quantity.where.line, 5);
}

TEST(StudyUncertain, ReadsANormalDistribution) {
  const Distribution between =
      uncertain_of("{mass: {normal: [2.0, 0.3], between: [1.0, 3.0]}}").at(0).distribution;
  EXPECT_EQ(between.kind, DistributionKind::kNormal);
  EXPECT_EQ(between.mean, 2.0);
  EXPECT_EQ(between.deviation, 0.3);
  EXPECT_EQ(between.lower, 1.0);
  EXPECT_EQ(between.upper, 3.0);
  const Distribution within_bounds =
      uncertain_of("{mass: {normal: [2.0, 0.3]}}").at(0).distribution;
  EXPECT_EQ(within_bounds.lower, 0.0);
  EXPECT_EQ(within_bounds.upper, 5.0);
  EXPECT_TRUE(std::isinf(uncertain_of("{free: {normal: [2.0, 0.3]}}").at(0).distribution.upper));
}

TEST(StudyUncertain, ReadsChoices) {
  const std::vector<UncertainQuantity> quantities =
      uncertain_of("{mass: {choice: [1.0, 2.0]}, friction_law: {choice: [lugre, brown_mcphee]}}");
  ASSERT_EQ(quantities.size(), 2U);
  EXPECT_EQ(quantities[0].distribution.kind, DistributionKind::kChoice);
  EXPECT_EQ(quantities[0].distribution.choices, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(quantities[1].name, "friction_law");
  EXPECT_EQ(quantities[1].parameter, -1);
  EXPECT_EQ(quantities[1].distribution.kind, DistributionKind::kChoice);
  EXPECT_EQ(quantities[1].distribution.choices, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(quantities[1].laws, (std::vector<std::string>{"lugre", "brown_mcphee"}));
}

TEST(StudyUncertain, AParameterMayHaveTheNameOfTheLaw) {
  const Study study = read_text(kLeastStudy +
                                "parameters: {friction_law: {initial: 1, tune: false}}\nuncertain: "
                                "{friction_law: {uniform: [1, 2]}}\n");
  EXPECT_EQ(study.ensemble.uncertain.at(0).parameter, 2);
  EXPECT_TRUE(study.ensemble.uncertain[0].laws.empty());
}

TEST(StudyUncertain, RefusesOtherForms) {
  expect_bad_uncertain("{mass: {}}", "uncertain.mass", "one distribution");
  expect_bad_uncertain("{mass: [1, 2]}", "uncertain.mass", "expected a map");
  expect_bad_uncertain("{mass: {uniform: [1, 2], choice: [1, 2]}}", "uncertain.mass",
                       "one distribution");
  expect_bad_uncertain("{mass: {gauss: [1, 2]}}", "uncertain.mass.gauss", "unknown key");
  expect_bad_uncertain("{mass: {uniform: [1, 2], between: [1, 2]}}", "uncertain.mass.between",
                       "between belongs to normal");
  expect_bad_uncertain("{mass: {between: [1, 2]}}", "uncertain.mass", "one distribution");
  EXPECT_EQ(allowed_by("{mass: {}}"),
            "one of uniform: [lower, upper], normal: [mean, deviation], choice: [a, b]");
}

TEST(StudyUncertain, RefusesBadRanges) {
  expect_bad_uncertain("{mass: {uniform: 1}}", "uncertain.mass.uniform", "expected a list");
  expect_bad_uncertain("{mass: {uniform: [1]}}", "uncertain.mass.uniform",
                       "two numbers are needed, found 1");
  expect_bad_uncertain("{mass: {uniform: [2, 1]}}", "uncertain.mass.uniform[0]", "must lie below");
  expect_bad_uncertain("{mass: {uniform: [1, 1]}}", "uncertain.mass.uniform[0]", "must lie below");
  expect_bad_uncertain("{mass: {uniform: [-1, 1]}}", "uncertain.mass.uniform[0]",
                       "outside the bounds of the parameter mass");
  expect_bad_uncertain("{mass: {uniform: [1, 6]}}", "uncertain.mass.uniform[1]",
                       "outside the bounds of the parameter mass");
  expect_bad_uncertain("{free: {uniform: [1, .inf]}}", "uncertain.free.uniform[1]", "not finite");
  EXPECT_EQ(allowed_by("{mass: {uniform: [1, 6]}}"), "[0, 5]");
}

TEST(StudyUncertain, RefusesBadNormalDistributions) {
  expect_bad_uncertain("{mass: {normal: [2]}}", "uncertain.mass.normal", "two numbers are needed");
  expect_bad_uncertain("{mass: {normal: [6, 1]}}", "uncertain.mass.normal[0]",
                       "outside the bounds");
  expect_bad_uncertain("{mass: {normal: [2, 0]}}", "uncertain.mass.normal[1]", "must be positive");
  expect_bad_uncertain("{mass: {normal: [2, -1]}}", "uncertain.mass.normal[1]", "must be positive");
  expect_bad_uncertain("{mass: {normal: [2, 1], between: [3, 2]}}", "uncertain.mass.between[0]",
                       "must lie below");
  expect_bad_uncertain("{mass: {normal: [2, 1], between: [1, 6]}}", "uncertain.mass.between[1]",
                       "outside the bounds");
  expect_bad_uncertain("{mass: {normal: [2, 1], between: [3, 4]}}", "uncertain.mass.normal[0]",
                       "the mean lies outside the range");
  EXPECT_EQ(allowed_by("{mass: {normal: [2, 1], between: [3, 4]}}"), "[3, 4]");
}

TEST(StudyUncertain, RefusesLawsThatTheModelCannotHave) {
  const std::string study =
      kLeastStudy + "uncertain: {friction_law: {choice: [gonthier, lugre]}}\n";
  const auto message = [&study](const RobotDescription& robot) {
    try {
      read_study({"study.yaml", study}, robot);
    } catch (const InputError& error) {
      return error.fault().element + ": " + error.fault().message;
    }
    return std::string();
  };
  RobotDescription robot = study_robot();
  robot.joints[1].friction->mu_dynamic = Quantity(0.0);
  EXPECT_EQ(message(robot),
            "uncertain.friction_law.choice[1]: the LuGre model divides by mu_dynamic, which is "
            "zero in the joint slider_joint");
  robot.joints[1].friction.reset();
  EXPECT_EQ(message(robot), "uncertain.friction_law: no joint of the model has friction");
}

}  // namespace
}  // namespace codesign
