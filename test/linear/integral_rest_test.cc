// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/integral_rest.h"

#include <cmath>

#include "statics/statics_cases.h"

namespace codesign {
namespace {

std::string arm_servos(const std::string& keys) {
  return "duration: 10\ninitial_state: {shoulder: {position: 0.1}, elbow: {position: "
         "0.2}}\ncontrollers:\n  one: {type: pid, input: shoulder/position, setpoint: 0.5, output: "
         "shoulder, gains: {" +
         keys +
         "}}\n  two: {type: pid, input: elbow/position, setpoint: -1.2, output: elbow, gains: {" +
         keys + "}}\n";
}

/// The posture of an arm whose servos have integrals.
void expect_rest(const std::string& keys) {
  const Problem problem = loaded(arm_urdf(), arm_servos(keys));
  RestingMechanism mechanism(*system_of(problem), problem.parameters());
  ASSERT_TRUE(mechanism.begin().ok());
  ASSERT_EQ(mechanism.integrals().size(), 2);
  EXPECT_NEAR(mechanism.errors()[0], 0.4, 1e-12);
  int steps = 0;
  const Status status = rest_without_error(&mechanism, problem.parameters(),
                                           system_of(problem)->whole_study(), nullptr, &steps);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_GT(steps, 3) << "at most 0.2 rad each";
  EXPECT_LT(mechanism.errors().cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT(mechanism.acceleration().cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(mechanism.q()[1], -1.2, 1e-10);
}

TEST(IntegralRest, OfTwoJointsFromAfar) {
  expect_rest("p: 30, i: 5");
  expect_rest("p: 0, i: 0.001");
}

TEST(IntegralRest, EndsWhenCancelled) {
  const Problem problem = loaded(arm_urdf(), arm_servos("p: 30, i: 5"));
  RestingMechanism mechanism(*system_of(problem), problem.parameters());
  ASSERT_TRUE(mechanism.begin().ok());
  const std::atomic<bool> cancel{true};
  int steps = 0;
  EXPECT_EQ(rest_without_error(&mechanism, problem.parameters(), system_of(problem)->whole_study(),
                               &cancel, &steps)
                .code,
            StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
