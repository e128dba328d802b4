// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job_feedback.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <cmath>

namespace codesign {
namespace {

using Message = mechanism_codesign::OptimizationProgress;

class JobFeedbackTest : public testing::Test {
 protected:
  JobFeedbackTest() { ros::Time::init(); }

  static Trial trial(int evaluation) {
    Trial trial;
    trial.evaluation = evaluation;
    trial.objective = 2.0;
    trial.rho = Eigen::Vector2d(1.0, 2.0);
    return trial;
  }

  std::vector<Message> told_;
  JobFeedback feedback_{"arm_1", {"a", "b"}, [this](const Message& message) { told_.push_back(message); }};
};

TEST_F(JobFeedbackTest, BeforeTheFirstTrialPointItTellsOnlyHowFarTheJobIs) {
  Progress progress;
  progress.stage = SearchStage::kScreening;
  progress.done = 3;
  progress.of = 40;
  progress.runs = 12;
  progress.remembered = 5;
  feedback_.tell(progress);
  ASSERT_EQ(told_.size(), 1U);
  const Message& message = told_[0];
  EXPECT_EQ(message.evaluation, 0U);
  EXPECT_EQ(message.code, "");
  EXPECT_TRUE(std::isnan(message.objective) && std::isnan(message.best_objective));
  EXPECT_EQ(message.job, "arm_1");
  EXPECT_EQ(message.stage, "screening");
  EXPECT_EQ(message.done, 3U);
  EXPECT_EQ(message.of, 40U);
  EXPECT_EQ(message.runs, 12U);
  EXPECT_EQ(message.remembered_runs, 5U);
  EXPECT_EQ(message.runs_per_second, 0.0);
  EXPECT_TRUE(std::isnan(message.seconds_left)) << "nothing is computed yet";
}

TEST_F(JobFeedbackTest, BetweenTrialPointsItRepeatsTheLastOne) {
  Progress progress;
  feedback_.tell(trial(7), progress);
  progress.stage = SearchStage::kValidating;
  progress.runs_per_second = 20.0;
  progress.seconds_left = 1.5;
  progress.is_bound = true;
  feedback_.tell(progress);
  feedback_.finish(progress);
  ASSERT_EQ(told_.size(), 3U);
  EXPECT_EQ(told_[0].stage, "searching");
  for (const Message& message : told_) {
    EXPECT_EQ(message.evaluation, 7U);
    EXPECT_EQ(message.objective, 2.0);
    EXPECT_EQ(message.values, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(message.parameters, (std::vector<std::string>{"a", "b"}));
  }
  EXPECT_EQ(told_[1].stage, "validating");
  EXPECT_EQ(told_[1].runs_per_second, 20.0);
  EXPECT_EQ(told_[1].seconds_left, 1.5);
  EXPECT_TRUE(told_[1].at_most);
  EXPECT_EQ(told_[2].seconds_left, 0.0);
  EXPECT_FALSE(told_[2].at_most);
}

TEST_F(JobFeedbackTest, NeverGoesBackToAnEarlierCountOfRuns) {
  Progress early, late;
  early.runs = 121;
  late.runs = 122;
  late.seconds_left = 3.0;
  feedback_.tell(late);
  feedback_.tell(early);
  feedback_.tell(trial(2), early);
  ASSERT_EQ(told_.size(), 3U);
  for (const Message& message : told_) {
    EXPECT_EQ(message.runs, 122U);
    EXPECT_EQ(message.seconds_left, 3.0);
  }
  EXPECT_EQ(told_[2].evaluation, 2U) << "a trial point is told whatever the order";
}

TEST_F(JobFeedbackTest, TheBagGetsTrialPointsAlone) {
  for (int k = 1; k <= 3; ++k) {
    feedback_.tell(trial(k), Progress());
    feedback_.tell(Progress());
  }
  EXPECT_EQ(told_.size(), 6U);
  const std::vector<Message> kept = feedback_.take();
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[2].evaluation, 3U);
}

}  // namespace
}  // namespace codesign
