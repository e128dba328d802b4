// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/margins.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

Warnings warnings_of(const std::string& constraint, const std::string& more = "",
                     const std::string& parameters = "") {
  return unsatisfiable_constraints(study_of(
      block("constraints: [" + constraint + "]\n" + more, "{algorithm: slsqp}", parameters)));
}

void expect_warning(const std::string& constraint) {
  const Warnings warnings = warnings_of(constraint);
  ASSERT_EQ(warnings.size(), 1U) << constraint;
  EXPECT_EQ(warnings[0].code, "unsatisfiable_constraint");
  EXPECT_NE(warnings[0].message.find("constraints[0]: no design within the parameters' bounds"),
            std::string::npos)
      << warnings[0].message;
  EXPECT_NE(warnings[0].message.find("the margin is at most"), std::string::npos)
      << warnings[0].message;
}

// Kp lies within 0 and 200, Kd within 0 and 50; mass is 2 unless it is tuned, within 0.1 and 10.
TEST(Margins, AConstraintThatNoDesignMeetsIsDoubted) {
  expect_warning("\"Kp + Kd >= 251\"");
  expect_warning("{expression: \"${Kp - 2*Kd}\", at_most: -101}");
  expect_warning("{expression: \"${(Kp + 1)/(Kd + 1)}\", at_least: 202}");
  expect_warning("\"Kp*mass >= 500\"");
  expect_warning("\"mass >= 3\"");
  expect_warning("\"sqrt(Kp) >= 15\"");
  expect_warning("\"min(Kp, Kd**2) >= 201\"");
  EXPECT_TRUE(
      warnings_of("\"Kp + Kd >= 250\", {expression: \"${Kp - 2*Kd}\", at_most: -100}").empty());
  EXPECT_TRUE(warnings_of("\"Kp*mass >= 500\"", "", ", mass: {}").empty());
  EXPECT_TRUE(warnings_of("\"mass >= 3\"", "runs: {a: {set: {mass: 4}}}\n").empty())
      << "a run has another value";
  EXPECT_TRUE(warnings_of("\"sqrt(Kp - 1) >= 15\"").empty()) << "of Kp = 0 there is no root";
}

TEST(Margins, AnEqualityIsMetOnBothSides) {
  const Problem problem = block(
      "constraints: [\"Kp == 20\", {expression: \"${Kd}\", between: [4, 4]}, \"Kp <= 30\"]\n");
  const Study& study = study_of(problem);
  ASSERT_EQ(study.constraints.size(), 3U);
  const auto left = [&](std::size_t k, double Kp, double Kd) {
    std::vector<double> parameters;
    for (const Parameter& parameter : study.parameters)
      parameters.push_back(parameter.name == "Kp"   ? Kp
                           : parameter.name == "Kd" ? Kd
                                                    : parameter.value);
    return margin_left(study.constraints[k], parameters);
  };
  EXPECT_EQ(left(0, 23.0, 4.0), -3.0);
  EXPECT_EQ(left(0, 18.0, 4.0), -2.0);
  EXPECT_EQ(left(1, 20.0, 5.0), -1.0);
  EXPECT_EQ(left(2, 20.0, 5.0), 10.0);
  EXPECT_FALSE(all_met(study, Eigen::Vector3d(-3.0, 0.0, 10.0)));
  EXPECT_TRUE(all_met(study, Eigen::Vector3d(-1e-9, 0.0, 10.0)));
  EXPECT_TRUE(may_begin(study, Eigen::Vector3d(-3.0, -1.0, 10.0)));
  EXPECT_FALSE(may_begin(study, Eigen::Vector3d(-3.0, -1.0, -10.0)));
  expect_warning("\"Kp + Kd == 251\"");
  expect_warning("\"Kp + Kd == -1\"");
  EXPECT_TRUE(warnings_of("\"Kp + Kd == 250\"").empty());
}

TEST(Margins, WhatCountsAsMetFollowsFromTheMagnitude) {
  const Problem problem =
      block("constraints: [\"Kp <= 30\", \"1e-9*Kp <= 1e-8*Kd\", \"0*Kp >= 0\"]\n");
  const Study& study = study_of(problem);
  EXPECT_DOUBLE_EQ(least_margin(study, study.constraints[0]), -1e-7);
  // 1e-8*5 - 1e-9*20 at the start, 1e-9*200 and 1e-8*50 over the ranges.
  EXPECT_DOUBLE_EQ(least_margin(study, study.constraints[1]), -1e-7 * (3e-8 + 2e-7 + 5e-7));
  EXPECT_DOUBLE_EQ(least_margin(study, study.constraints[2]), -1e-7) << "nothing is known of it";
  EXPECT_TRUE(all_met(study, Eigen::Vector3d(-0.9e-7, 0.0, 0.0)));
  EXPECT_FALSE(all_met(study, Eigen::Vector3d(0.0, -0.9e-13, 0.0)));
}

TEST(Margins, BoundsThatSettingsPutOutOfOrderAreRefused) {
  const Problem problem =
      block("constraints: [{expression: \"${Kp}\", between: [\"${10*mass}\", 30]}]\n");
  EXPECT_NO_THROW(with_settings(problem, {{"mass", 2.5}}));
  try {
    with_settings(problem, {{"mass", 4.0}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the lower bound must be less than the upper one"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
