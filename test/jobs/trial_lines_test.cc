// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "jobs/trial_lines.h"

namespace codesign {
namespace {

/// One parameter from 0 to 10, which starts at 5.
Study one_parameter() {
  Study study;
  Parameter parameter;
  parameter.name = "x";
  parameter.value = 5.0;
  parameter.lower = 0.0;
  parameter.upper = 10.0;
  study.parameters = {parameter};
  study.tuned = {0};
  return study;
}

Trial trial_at(int evaluation, int iteration, double x) {
  Trial trial;
  trial.evaluation = evaluation;
  trial.iteration = iteration;
  trial.objective = trial.best_objective = x * x;
  trial.gradient_norm = 0.5;
  trial.rho = Eigen::VectorXd::Constant(1, x);
  return trial;
}

TEST(TimeLeft, InSecondsMinutesOrHours) {
  EXPECT_EQ(time_left(12.0, false), ", about 12 s left");
  EXPECT_EQ(time_left(300.0, true), ", at most 5 min left");
  EXPECT_EQ(time_left(9000.0, true), ", at most 2.5 h left");
  EXPECT_EQ(time_left(std::nullopt, true), "");
  EXPECT_EQ(time_left(0.0, false), "");
}

TEST(TrialLines, TellObjectiveStepAndTimeLeft) {
  const Study study = one_parameter();
  TrialLines lines(study);
  Progress progress;
  EXPECT_EQ(lines.line(trial_at(1, 0, 5.0), progress),
            "trial 1: objective 25, scaled gradient 0.5, best 25");
  progress.seconds_left = 12.0;
  progress.is_bound = true;
  EXPECT_EQ(lines.line(trial_at(2, 1, 4.0), progress),
            "trial 2: objective 16, scaled gradient 0.5, step 0.1, best 16, at most 12 s left");
}

TEST(TrialLines, TheStepIsFromTheBestPointOfTheSameSearch) {
  const Study study = one_parameter();
  TrialLines lines(study);
  lines.line(trial_at(1, 0, 5.0), {});
  EXPECT_NE(lines.line(trial_at(2, 0, 9.0), {}).find("step 0.4,"), std::string::npos)
      << "no improvement";
  EXPECT_NE(lines.line(trial_at(3, 1, 4.0), {}).find("step 0.1,"), std::string::npos)
      << "from 5, not from 9";
  EXPECT_NE(lines.line(trial_at(4, 2, 3.0), {}).find("step 0.1,"), std::string::npos) << "from 4";
  Trial other = trial_at(5, 2, 8.0);
  other.start = 2;
  const std::string line = lines.line(other, {});
  EXPECT_EQ(line.substr(0, 18), "search 2, trial 5:");
  EXPECT_EQ(line.find("step"), std::string::npos) << "the first of its search";
}

TEST(TrialLines, AFailedTrialTellsWhy) {
  const Study study = one_parameter();
  Trial trial = trial_at(1, 0, 5.0);
  trial.status = {StatusCode::kAssemblyFailed, 0.0, "the loop cannot close"};
  EXPECT_NE(TrialLines(study).line(trial, {}).find("failed, "), std::string::npos);
}

FitTrial fit_at(int evaluation, int iteration, double x) {
  FitTrial trial;
  trial.evaluation = evaluation;
  trial.iteration = iteration;
  trial.cost = 3.0;
  trial.rms = Eigen::VectorXd::Constant(1, 0.25);
  trial.x = Eigen::VectorXd::Constant(1, x);
  return trial;
}

TEST(FitLines, TellCostStepAndTimeLeft) {
  FitLines lines(100);
  const std::string first = lines.line(fit_at(1, 0, 2.0)), second = lines.line(fit_at(2, 1, 1.0));
  EXPECT_EQ(first.substr(0, 50), "evaluation 1: cost 3, root mean squares 0.25, at m");
  EXPECT_NE(second.find("step 0.5, at most"), std::string::npos) << second;
}

TEST(FitLines, OfAProfileItsBeginning) {
  FitLines lines(100);
  FitTrial trial = fit_at(7, 3, 2.0);
  trial.profile = 2;
  trial.profiles = 5;
  EXPECT_EQ(lines.line(trial), "profile 2 of 5");
  EXPECT_EQ(lines.line(trial), "");
}

TEST(ProgressLine, SaysWhatIsDoneHowFastAndHowLong) {
  Progress progress;
  progress.stage = SearchStage::kScreening;
  progress.done = 12;
  progress.of = 400;
  progress.runs = 288;
  progress.runs_per_second = 31.25;
  progress.seconds_left = 298.0;
  EXPECT_EQ(progress_line(progress),
            "screening: 12 of 400 points, 288 runs, 31.2 runs/s, about 5 min left");
  progress.stage = SearchStage::kSearching;
  progress.starts = progress.of = 100;
  progress.seconds_left = 12.34;
  EXPECT_EQ(progress_line(progress),
            "searching: 12 of 100 searches ended, 288 runs, 31.2 runs/s, about 12 s left");
  progress.seconds_left = 111.0;
  EXPECT_NE(progress_line(progress).find("about 111 s left"), std::string::npos);
  progress.starts = 0;
  progress.of = 200;
  progress.is_bound = true;
  progress.seconds_left = 9000.0;
  EXPECT_EQ(progress_line(progress),
            "searching: 12 of at most 200 evaluations, 288 runs, 31.2 runs/s, at most 2.5 h left");
}

TEST(ProgressLine, LeavesOutWhatIsNotKnown) {
  Progress progress;
  progress.stage = SearchStage::kValidating;
  progress.of = 1000;
  EXPECT_EQ(progress_line(progress), "validating: 0 of 1000 runs, 0 runs");
}

}  // namespace

}  // namespace codesign
