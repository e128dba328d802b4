// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "ros/jobs/job.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

using mechanism_codesign::EvaluateRequest;

class EvaluationJob : public testing::Test {
 protected:
  mechanism_codesign::EvaluateResponse run(const EvaluateRequest& request) {
    return run_evaluation(pendulum(), request, cancel_);
  }
  std::atomic<bool> cancel_{false};
};

TEST_F(EvaluationJob, GivesObjectiveAndGradientAtTheStart) {
  const auto reply = run(EvaluateRequest());
  EXPECT_TRUE(reply.success) << reply.message;
  EXPECT_EQ(reply.values, (std::vector<double>{0.5, 1.0}));
  EXPECT_GT(reply.objective, 0.0);
  EXPECT_EQ(reply.gradient.size(), 2U);
  EXPECT_TRUE(reply.reference.empty());
  EXPECT_EQ(reply.constraint_drift, 0.0) << "without loops joint coordinates have no constraints";
  EXPECT_GT(reply.energy_error, 0.0);
  EXPECT_LT(reply.energy_error, 1e-4);
}

TEST_F(EvaluationJob, TheObjectiveAloneIsTheSame) {
  EvaluateRequest request;
  request.objective_only = 1;
  const auto reply = run(request);
  EXPECT_TRUE(reply.gradient.empty());
  EXPECT_NEAR(reply.objective, run(EvaluateRequest()).objective, 1e-6 * reply.objective);
}

TEST_F(EvaluationJob, ChecksItsGradient) {
  for (const auto& [check, tolerance] :
       {std::pair<const char*, double>{"complex_step", 1e-9}, {"ridders", 1e-4}}) {
    EvaluateRequest request;
    request.check = check;
    const auto reply = run(request);
    ASSERT_TRUE(reply.success) << reply.message;
    ASSERT_EQ(reply.reference.size(), 2U);
    for (int k : {0, 1})
      EXPECT_NEAR(reply.gradient[k], reply.reference[k], tolerance * std::abs(reply.reference[k]))
          << check;
    EXPECT_LT(reply.largest_relative_difference, tolerance);
  }
}

TEST_F(EvaluationJob, TellsConstraintsAndSignals) {
  const Problem problem = block(
      "path: [{signal: slide/velocity, at_most: 0.5}]\nconstraints: [\"Kp - 4*Kd <= 100\"]\n"
      "runs: {one: {}, two: {set: {mass: 8.0}}}\nrobust: {measure: worst}\n");
  mechanism_codesign::EvaluateResponse first;
  for (const std::string check : {"", "complex_step"}) {
    EvaluateRequest request;
    request.check = check;
    const auto reply = run_evaluation(problem, request, cancel_);
    ASSERT_TRUE(reply.success) << reply.message;
    ASSERT_EQ(reply.constraints.size(), 1U);
    EXPECT_EQ(reply.margins, (std::vector<double>{100.0}));
    ASSERT_EQ(reply.signals.size(), 1U);
    EXPECT_EQ(reply.signals[0].upper, 0.5);
    EXPECT_NEAR(reply.signals[0].largest, 1.0, 1e-9) << "the initial velocity";
    EXPECT_EQ(reply.signals[0].largest_time, 0.0);
    EXPECT_NEAR(reply.signals[0].violation, 0.5, 1e-9);
    EXPECT_EQ(reply.signals[0].initial_largest, reply.signals[0].largest);
    if (check.empty()) first = reply;
    EXPECT_NEAR(reply.signals[0].smallest, first.signals[0].smallest, 1e-6);
  }
}

TEST_F(EvaluationJob, AnUnknownCheckNamesTheNearest) {
  EvaluateRequest request;
  request.check = "complexstep";
  const auto reply = run(request);
  EXPECT_EQ(reply.code, "bad_input");
  EXPECT_NE(reply.message.find("complex_step"), std::string::npos) << reply.message;
}

}  // namespace
}  // namespace codesign
