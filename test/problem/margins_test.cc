// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/margins.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

void expect_refused(const std::string& constraint, const std::string& more = "", const std::string& parameters = "") {
  try {
    block("constraints: [" + constraint + "]\n" + more, "{algorithm: slsqp}", parameters);
    ADD_FAILURE() << "accepted: " << constraint;
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "constraints[0]");
    EXPECT_NE(error.fault().message.find("no design within the parameters' bounds"), std::string::npos) << error.what();
    EXPECT_NE(error.fault().allowed.find("the margin is at most"), std::string::npos) << error.what();
  }
}

// Kp lies within 0 and 200, Kd within 0 and 50; mass is 2 unless it is tuned, within 0.1 and 10.
TEST(Margins, AConstraintThatNoDesignMeetsIsRefused) {
  expect_refused("\"Kp + Kd >= 251\"");
  expect_refused("{expression: \"${Kp - 2*Kd}\", at_most: -101}");
  expect_refused("{expression: \"${(Kp + 1)/(Kd + 1)}\", at_least: 202}");
  expect_refused("\"Kp*mass >= 500\"");
  expect_refused("\"mass >= 3\"");
  EXPECT_NO_THROW(block("constraints: [\"Kp + Kd >= 250\", {expression: \"${Kp - 2*Kd}\", at_most: -100}]\n"));
  EXPECT_NO_THROW(block("constraints: [\"Kp*mass >= 500\"]\n", "{algorithm: slsqp}", ", mass: {}"));
  EXPECT_NO_THROW(block("constraints: [\"mass >= 3\"]\nruns: {a: {set: {mass: 4}}}\n")) << "a run has another value";
  EXPECT_NO_THROW(block("constraints: [\"sqrt(Kp) >= 15\"]\n")) << "not known cheaply";
}

TEST(Margins, BoundsThatSettingsPutOutOfOrderAreRefused) {
  const Problem problem = block("constraints: [{expression: \"${Kp}\", between: [\"${10*mass}\", 30]}]\n");
  EXPECT_NO_THROW(with_settings(problem, {{"mass", 2.5}}));
  try {
    with_settings(problem, {{"mass", 4.0}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the lower bound must be less than the upper one"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace codesign
