// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/identification_feedback.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

class IdentificationFeedbackTest : public testing::Test {
 protected:
  IdentificationFeedbackTest() { ros::Time::init(); }

  FitTrial trial(int evaluation, int profile = 0) const {
    FitTrial one{evaluation, {}, 4.0, Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Constant(2, 3.0), {"hinge"}, 1, profile, 5};
    return one;
  }

  std::vector<mechanism_codesign::IdentificationProgress> told_;
  IdentificationFeedback feedback_{"arm_1", {"inertia", "viscous"}, 10, [this](const auto& progress) { told_.push_back(progress); }};
};

TEST_F(IdentificationFeedbackTest, TellsStagesEvaluationsAndTheTimeLeft) {
  feedback_.begin("reading");
  feedback_.tell(trial(1));
  feedback_.tell(trial(2));
  feedback_.tell(trial(3, 1));
  feedback_.tell(trial(4, 2));
  feedback_.begin("recording");
  feedback_.finish();
  ASSERT_EQ(told_.size(), 7U);
  const char* stages[] = {"reading", "fitting", "fitting", "profiling", "profiling", "recording", "recording"};
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
  feedback_.tell(trial(1));
  feedback_.tell(trial(2, 1));
  const auto kept = feedback_.take();
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].evaluation, 1U);
}

TEST_F(IdentificationFeedbackTest, AFailedEvaluationSaysWhy) {
  FitTrial failed = trial(2);
  failed.status = {StatusCode::kAssemblyFailed, 0.0, "the rod does not reach"};
  failed.rms.resize(0);
  feedback_.tell(failed);
  EXPECT_EQ(told_[0].code, "assembly_failed");
  EXPECT_EQ(told_[0].message, "the rod does not reach");
  EXPECT_TRUE(told_[0].rms.empty());
}

}  // namespace
}  // namespace codesign
