// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/feedback.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <cmath>

namespace codesign {
namespace {

class IdentificationFeedbackTest : public testing::Test {
 protected:
  IdentificationFeedbackTest() { ros::Time::init(); }

  FitTrial trial(int evaluation, int profile = 0) const {
    FitTrial one{evaluation,
                 {},
                 4.0,
                 Eigen::VectorXd::Constant(1, 0.5),
                 Eigen::VectorXd::Constant(2, 3.0),
                 {"hinge"},
                 1,
                 profile,
                 5};
    return one;
  }

  std::vector<mechanism_codesign::IdentificationProgress> told_;
  IdentificationFeedback feedback_{
      "arm_1", {"inertia", "viscous"}, 10, [this](const auto& progress) {
        told_.push_back(progress);
      }};
};

TEST_F(IdentificationFeedbackTest, TellsStagesEvaluationsAndTheTimeLeft) {
  feedback_.begin("reading");
  feedback_.publish(trial(1));
  feedback_.publish(trial(2));
  feedback_.publish(trial(3, 1));
  feedback_.publish(trial(4, 2));
  feedback_.begin("recording");
  feedback_.finish();
  ASSERT_EQ(told_.size(), 7U);
  const char* stages[] = {"reading",   "fitting",   "fitting",  "profiling",
                          "profiling", "recording", "recording"};
  for (std::size_t k = 0; k < told_.size(); ++k) {
    EXPECT_EQ(told_[k].stage, stages[k]);
    EXPECT_EQ(told_[k].job, "arm_1");
    EXPECT_EQ(told_[k].names.size(), 2U);
    EXPECT_GE(told_[k].seconds, 0.0);
  }
  EXPECT_EQ(told_[0].evaluation, 0U);
  EXPECT_TRUE(std::isnan(told_[0].seconds_left));
  EXPECT_TRUE(std::isnan(told_[0].cost));
  EXPECT_EQ(told_[2].evaluation, 2U);
  EXPECT_EQ(told_[2].done, 2U);
  EXPECT_EQ(told_[2].of, 10U);
  EXPECT_EQ(told_[2].joints, std::vector<std::string>{"hinge"});
  EXPECT_EQ(told_[2].rms, std::vector<double>{0.5});
  EXPECT_GE(told_[2].seconds_left, 0.0);
  EXPECT_TRUE(told_[2].at_most) << "a fit may end before its last evaluation";
  EXPECT_TRUE(std::isnan(told_[3].seconds_left)) << "no profile is complete";
  EXPECT_EQ(told_[4].done, 1U);
  EXPECT_EQ(told_[4].of, 5U);
  EXPECT_FALSE(told_[4].at_most);
  EXPECT_EQ(told_[6].seconds_left, 0.0);
}

TEST_F(IdentificationFeedbackTest, TheBagGetsTheEvaluationsOfTheFit) {
  feedback_.begin("reading");
  feedback_.publish(trial(1));
  feedback_.publish(trial(2, 1));
  const auto kept = feedback_.take();
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].evaluation, 1U);
}

TEST_F(IdentificationFeedbackTest, AFailedEvaluationSaysWhy) {
  FitTrial failed = trial(2);
  failed.status = {StatusCode::kAssemblyFailed, 0.0, "the rod does not reach"};
  failed.rms.resize(0);
  feedback_.publish(failed);
  EXPECT_EQ(told_[0].code, "assembly_failed");
  EXPECT_EQ(told_[0].message, "the rod does not reach");
  EXPECT_TRUE(told_[0].rms.empty());
}

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
  JobFeedback feedback_{
      "arm_1", {"a", "b"}, [this](const Message& message) { told_.push_back(message); }};
};

TEST_F(JobFeedbackTest, BeforeTheFirstTrialPointItTellsOnlyHowFarTheJobIs) {
  Progress progress;
  progress.stage = SearchStage::kScreening;
  progress.done = 3;
  progress.of = 40;
  progress.runs = 12;
  progress.remembered = 5;
  feedback_.publish(progress);
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
  feedback_.publish(trial(7), progress);
  progress.stage = SearchStage::kValidating;
  progress.runs_per_second = 20.0;
  progress.seconds_left = 1.5;
  progress.is_bound = true;
  feedback_.publish(progress);
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
  feedback_.publish(late);
  feedback_.publish(early);
  feedback_.publish(trial(2), early);
  ASSERT_EQ(told_.size(), 3U);
  for (const Message& message : told_) {
    EXPECT_EQ(message.runs, 122U);
    EXPECT_EQ(message.seconds_left, 3.0);
  }
  EXPECT_EQ(told_[2].evaluation, 2U) << "a trial point is told whatever the order";
}

TEST_F(JobFeedbackTest, TheBagGetsTrialPointsAlone) {
  for (int k = 1; k <= 3; ++k) {
    feedback_.publish(trial(k), Progress());
    feedback_.publish(Progress());
  }
  EXPECT_EQ(told_.size(), 6U);
  const std::vector<LoggedTrial> kept = feedback_.take();
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[2].trial.evaluation, 3);
}

std::vector<unsigned> kept_of(unsigned count, std::size_t capacity) {
  TrialLog log(capacity);
  for (unsigned k = 1; k <= count; ++k) {
    LoggedTrial logged;
    logged.trial.evaluation = static_cast<int>(k);
    log.add(logged);
  }
  std::vector<unsigned> evaluations;
  for (const LoggedTrial& logged : log.take())
    evaluations.push_back(static_cast<unsigned>(logged.trial.evaluation));
  return evaluations;
}

TEST(TrialLog, KeepsAllWhileThereIsRoom) {
  EXPECT_EQ(kept_of(4, 4), (std::vector<unsigned>{1, 2, 3, 4}));
}

TEST(TrialLog, ThinsEvenlyAndKeepsTheLast) {
  EXPECT_EQ(kept_of(5, 4), (std::vector<unsigned>{1, 3, 5}));
  EXPECT_EQ(kept_of(8, 4), (std::vector<unsigned>{1, 3, 5, 7, 8}));
  EXPECT_EQ(kept_of(10, 4), (std::vector<unsigned>{1, 5, 9, 10}));
}

TEST(TrialLog, StaysWithinItsCapacity) { EXPECT_LE(kept_of(100000, 10).size(), 11U); }

TEST(TrialLog, MayBeEmpty) { EXPECT_TRUE(kept_of(0, 4).empty()); }

}  // namespace
}  // namespace codesign
