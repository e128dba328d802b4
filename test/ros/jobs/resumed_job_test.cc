// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Jobs that continue from a journal, and the files that cancelled jobs leave.
#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "ensemble/ensemble_fixture.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/jobs/job.h"
#include "ros/pendulum.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using mechanism_codesign::OptimizeGoal;
using mechanism_codesign::OptimizeResult;
using Progress = mechanism_codesign::OptimizationProgress;

class ResumedJob : public testing::Test {
 protected:
  ResumedJob() { ros::Time::init(); }

  OptimizeResult run(const OptimizeGoal& request = {}, const FeedbackObserver& observer = {}) {
    return run_optimization(problem_, "the study", request, {directory_.path().string(), 20.0},
                            observer, cancel_)
        .result;
  }
  OptimizeResult cancelled_at(unsigned evaluation) {
    const OptimizeResult result = run({}, [&](const Progress& progress) {
      cancel_ = cancel_ || progress.evaluation >= evaluation;
    });
    cancel_ = false;
    return result;
  }
  /// The name of a job whose process was killed at its trial point `evaluation`.
  std::string killed_at(unsigned evaluation) {
    const pid_t child = fork();
    if (child == 0) {
      run({}, [&](const Progress& progress) {
        if (progress.evaluation >= evaluation) raise(SIGKILL);
      });
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    const std::vector<std::string> journals = files(".journal.jsonl");
    return journals.size() == 1 ? journals[0] : "";
  }
  static OptimizeGoal resuming(const std::string& job) {
    OptimizeGoal request;
    request.resume = job;
    return request;
  }
  /// Names without the ending, of files with it.
  std::vector<std::string> files(const std::string& ending) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_.path())) {
      const std::string name = entry.path().filename();
      const bool ends = name.size() > ending.size() &&
                        name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
      if (ends) names.push_back(name.substr(0, name.size() - ending.size()));
    }
    return names;
  }
  std::size_t lines(const std::string& job) const {
    std::ifstream file(directory_.path() / (job + ".journal.jsonl"));
    std::size_t count = 0;
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }
  /// All that does not depend on when, where and in how many processes a job ran.
  static OptimizeResult without_circumstances(OptimizeResult result) {
    result.cpu_seconds = result.setup_seconds = 0.0;
    result.bag = result.job = "";
    result.remembered_runs = 0;
    return result;
  }

  TemporaryDirectory directory_;
  std::atomic<bool> cancel_{false};
  const Problem problem_ = pendulum();
};

TEST_F(ResumedJob, AKilledOneEndsAsIfItHadNotBeenAndComputesNothingTwice) {
  const OptimizeResult whole = run();
  ASSERT_TRUE(whole.success) << whole.message;
  EXPECT_EQ(whole.remembered_runs, 0U);
  EXPECT_EQ(whole.runs, whole.evaluations + 1) << "one more looks for flat directions at the end";
  EXPECT_TRUE(files(".journal.jsonl").empty()) << "an ended job needs none";
  for (const unsigned at : {1U, whole.evaluations / 2, whole.evaluations}) {
    const std::string job = killed_at(at);
    ASSERT_NE(job, "");
    const std::size_t before = lines(job) - 1;
    EXPECT_EQ(before, at);
    const OptimizeResult result = run(resuming(job));
    EXPECT_EQ(without_circumstances(result), without_circumstances(whole));
    EXPECT_EQ(result.remembered_runs, before);
    EXPECT_EQ(result.job, job);
    EXPECT_EQ(result.bag, (directory_.path() / (job + ".bag")).string());
    for (const char* gone : {".journal.jsonl", ".job", ".best.json", ".best.urdf", ".active"})
      EXPECT_TRUE(files(gone).empty()) << gone;
  }
}

TEST_F(ResumedJob, ACancelledOneGoesOnAndItsBagStays) {
  const OptimizeResult whole = run(), first = cancelled_at(1), second = [&] {
    OptimizeResult result = run(
        resuming(first.job), [&](const Progress& progress) { cancel_ = progress.evaluation >= 3; });
    cancel_ = false;
    return result;
  }();
  EXPECT_EQ(first.code, "cancelled");
  EXPECT_EQ(second.code, "cancelled");
  EXPECT_EQ(second.remembered_runs, 1U);
  const OptimizeResult result = run(resuming(first.job));
  EXPECT_EQ(without_circumstances(result), without_circumstances(whole));
  EXPECT_EQ(result.remembered_runs, 3U);
  const std::string stem = (directory_.path() / first.job).string();
  EXPECT_EQ(first.bag, stem + ".bag");
  EXPECT_EQ(second.bag, stem + ".resumed.bag");
  EXPECT_EQ(result.bag, stem + ".resumed-2.bag");
  EXPECT_EQ(files(".bag").size(), 4U);
  EXPECT_TRUE(files(".journal.jsonl").empty());
  EXPECT_NE(run(resuming(first.job)).message.find("the job is complete"), std::string::npos);
}

TEST_F(ResumedJob, AnotherRequestIsRefusedAndLosesNothing) {
  const std::string job = cancelled_at(2).job;
  OptimizeGoal other = resuming(job);
  other.max_evaluations = 7;
  const OptimizeResult refusal = run(other);
  EXPECT_EQ(refusal.code, "bad_input");
  EXPECT_NE(refusal.message.find("the options of the optimizer differ"), std::string::npos)
      << refusal.message;
  other = resuming(job);
  other.start = {0.4, 1.0};
  EXPECT_NE(run(other).message.find("a request's start"), std::string::npos);
  EXPECT_EQ(run(resuming("../" + job)).code, "bad_input");
  EXPECT_EQ(lines(job), 3U);
  EXPECT_TRUE(files(".job").empty());
  EXPECT_TRUE(run(resuming(job)).success);
}

TEST_F(ResumedJob, ADamagedLineIsNamedAndComputedAgain) {
  const OptimizeResult whole = run();
  const std::string job = cancelled_at(2).job;
  const std::string path = (directory_.path() / (job + ".journal.jsonl")).string();
  std::string text = read_source(path).text;
  const std::size_t gradient = text.find("\"gradient\":[") + 12;
  text.erase(gradient, text.find(']', gradient) - gradient);
  std::ofstream(path) << text;
  OptimizeResult result = run(resuming(job));
  ASSERT_TRUE(result.success) << result.message;
  EXPECT_EQ(result.remembered_runs, 1U);
  const auto is_it = [](const auto& warning) { return warning.code == "journal_damaged"; };
  const auto warning = std::find_if(result.warnings.begin(), result.warnings.end(), is_it);
  ASSERT_NE(warning, result.warnings.end());
  EXPECT_NE(warning->message.find("line 2 is damaged"), std::string::npos) << warning->message;
  result.warnings.erase(warning);
  EXPECT_EQ(without_circumstances(result), without_circumstances(whole));
}

TEST_F(ResumedJob, ARunningOneIsBusy) {
  std::string code, message;
  run({}, [&](const Progress& progress) {
    if (!code.empty()) return;
    const OptimizeResult refusal = run(resuming(progress.job));
    code = refusal.code;
    message = refusal.message;
  });
  EXPECT_EQ(code, "busy");
  EXPECT_NE(message.find("is running"), std::string::npos) << message;
}

TEST_F(ResumedJob, CancelledBeforeTheFirstEvaluationItCanBeResumed) {
  cancel_ = true;
  const OptimizeResult first = run();
  cancel_ = false;
  EXPECT_EQ(first.code, "cancelled");
  const OptimizeResult result = run(resuming(first.job));
  EXPECT_TRUE(result.success) << result.message;
  EXPECT_EQ(result.remembered_runs, 0U);
}

TEST_F(ResumedJob, ABadAlgorithmLeavesNoJournal) {
  OptimizeGoal request;
  request.algorithm = "newton_raphson";
  EXPECT_EQ(run(request).code, "bad_input");
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

/// Minutes of computing: a cancel does not wait until both runs are recorded to their ends.
TEST(CancelledJob, DoesNotWaitForTheEndOfLongRuns) {
  ros::Time::init();
  const Problem usual = pendulum();
  std::string study = usual.study_text().text;
  study.replace(study.find("duration: 0.5"), 13, "duration: 20000.0");
  study.replace(study.find("absolute_tolerance: 1.0e-7"), 26,
                "absolute_tolerance: 1.0e-7, maximum_steps: 100000000");
  const Problem problem = load_problem(usual.urdf(), {}, {"pendulum.yaml", study});
  TemporaryDirectory directory;
  std::atomic<bool> cancel{true};
  const OptimizeResult result =
      run_optimization(problem, "", {}, {directory.path().string(), 1.0}, {}, cancel).result;
  EXPECT_EQ(result.code, "cancelled");
  EXPECT_TRUE(std::filesystem::exists(result.bag));
  EXPECT_EQ(std::count_if(result.warnings.begin(), result.warnings.end(),
                          [](const auto& one) { return one.code == "run_ends_early"; }),
            2);
}

TEST(JobOfAnEnsemble, TheWorstRunsDescriptionHasTheFrictionLawOfItsSample) {
  ros::Time::init();
  TemporaryDirectory directory;
  const std::atomic<bool> cancel{false};
  const Problem problem = block(
      "uncertain: {friction_law: {choice: [lugre, gonthier]}}\nrobust: {measure: worst, samples: "
      "4}\n");
  const OptimizeResult result =
      run_optimization(problem, "", {}, {directory.path().string(), 20.0}, {}, cancel).result;
  ASSERT_TRUE(result.success) << result.message;
  const std::string law = result.scenarios.at(result.worst - 1).friction_law;
  ASSERT_NE(law, "");
  rosbag::Bag bag(result.bag);
  const auto law_in = [&bag](const std::string& place) {
    rosbag::View view(bag, rosbag::TopicQuery(place + "robot_description"));
    const RobotDescription robot =
        read_urdf({place, view.begin()->instantiate<std_msgs::String>()->data});
    return std::string(robot.joints.at(0).friction->model->name);
  };
  EXPECT_EQ(law_in("worst/tuned/"), law);
  EXPECT_EQ(law_in("worst/initial/"), law);
  EXPECT_EQ(law_in("tuned/"), "brown_mcphee");
}

TEST(JobWithBounds, ReportsTheSignals) {
  ros::Time::init();
  TemporaryDirectory directory;
  const std::atomic<bool> cancel{false};
  const Problem problem = block(
      "path: [{signal: slide/velocity, at_most: 1.5}]\nfinal: [{signal: slide/position, between: "
      "[0.4, 0.6]}]\n");
  const OptimizeResult result =
      run_optimization(problem, "", {}, {directory.path().string(), 20.0}, {}, cancel).result;
  ASSERT_EQ(result.signals.size(), 2U) << result.message;
  EXPECT_EQ(result.signals[0].element, "path[0]");
  EXPECT_EQ(result.signals[0].upper, 1.5);
  EXPECT_NEAR(result.signals[0].initial_largest, 1.0, 1e-9) << "the initial velocity";
  EXPECT_EQ(result.signals[1].lower, 0.4);
  EXPECT_EQ(result.signals[1].violation, 0.0);
  EXPECT_TRUE(result.signals[1].smallest >= 0.4 - 1e-8 && result.signals[1].largest <= 0.6 + 1e-8);
  rosbag::Bag bag(result.bag);
  rosbag::View view(bag, rosbag::TopicQuery("result"));
  EXPECT_EQ(view.begin()->instantiate<OptimizeResult>()->signals, result.signals);
}

}  // namespace
}  // namespace codesign
