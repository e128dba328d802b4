// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>

#include "ensemble/ensemble_fixture.h"
#include "jobs/saved_result.h"
#include "mechanism_codesign/gradient.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/jobs/job.h"
#include "ros/pendulum.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using mechanism_codesign::OptimizeGoal;

class OptimizationJob : public testing::Test {
 protected:
  OptimizationJob() { ros::Time::init(); }

  OptimizationOutcome run(const OptimizeGoal& request = OptimizeGoal(),
                          const FeedbackObserver& observer = {}) {
    return run_optimization(pendulum(), "the study", request, {directory_.path().string(), 20.0},
                            observer, cancel_);
  }

  bool left_nothing() const { return std::filesystem::is_empty(directory_.path()); }

  TemporaryDirectory directory_;
  std::atomic<bool> cancel_{false};
};

TEST_F(OptimizationJob, ImprovesAndReportsEveryTrial) {
  unsigned trials = 0;
  const auto result =
      run(OptimizeGoal(), [&](const mechanism_codesign::OptimizationProgress& progress) {
        // Between trial points the last one may be repeated.
        EXPECT_LE(progress.evaluation, trials + 1);
        trials = progress.evaluation;
      }).result;
  EXPECT_TRUE(result.success) << result.message;
  EXPECT_EQ(result.code, "success");
  EXPECT_EQ(result.parameters, (std::vector<std::string>{"length", "Kp"}));
  EXPECT_EQ(result.initial, (std::vector<double>{0.5, 1.0}));
  EXPECT_LT(result.objective, result.initial_objective);
  EXPECT_EQ(result.tuned.size(), 2U);
  EXPECT_EQ(result.gradient.size(), 2U);
  EXPECT_EQ(result.evaluations, trials);
  EXPECT_FALSE(result.termination.empty());
}

TEST_F(OptimizationJob, TheTunedDescriptionHasTheTunedParameters) {
  const OptimizationOutcome outcome = run();
  const RobotDescription robot = read_urdf({"tuned", outcome.tuned_urdf});
  ASSERT_EQ(robot.parameters[0].name, "length");
  EXPECT_EQ(robot.parameters[0].value, outcome.result.tuned[0]);
}

TEST_F(OptimizationJob, TheBagHoldsBothRuns) {
  rosbag::Bag bag(run().result.bag);
  for (const std::string topic : {"initial/joint_states", "tuned/joint_states"}) {
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    EXPECT_EQ(view.size(), 11U);  // 0.5 s at 20 a second
    const auto first = view.begin()->instantiate<sensor_msgs::JointState>();
    EXPECT_EQ(first->name, std::vector<std::string>{"hinge"});
    EXPECT_NEAR(first->position.at(0), 0.5, 1e-12);
  }
}

TEST_F(OptimizationJob, AMassIsChosenFromAList) {
  const Problem problem =
      block("", "{algorithm: slsqp, max_evaluations: 60}", ", mass: {choice: [1.0, 2.5, 6.0]}");
  const auto result =
      run_optimization(problem, "", OptimizeGoal(), {directory_.path().string(), 20.0}, {}, cancel_)
          .result;
  ASSERT_TRUE(result.success) << result.message;
  EXPECT_EQ(result.termination, "all_combinations_searched");
  ASSERT_EQ(result.parameters.back(), "mass");
  const std::set<double> list{1.0, 2.5, 6.0};
  EXPECT_EQ(list.count(result.tuned.back()), 1u) << result.tuned.back();
  EXPECT_EQ(result.initial.back(), 2.5) << "the nearest to the model's";
}

TEST_F(OptimizationJob, OfAStudyWithScenariosTheBagHoldsTheWorstRun) {
  const Problem problem = block(
      "runs: {light: {set: {mass: 1.0}}, heavy: {set: {mass: 8.0}}}\nrobust: {measure: worst}\n");
  const auto result =
      run_optimization(problem, "", OptimizeGoal(), {directory_.path().string(), 20.0}, {}, cancel_)
          .result;
  ASSERT_TRUE(result.success) << result.message;
  ASSERT_EQ(result.scenarios.size(), 2U);
  ASSERT_GT(result.worst, 0U);
  const mechanism_codesign::ScenarioResult& worst = result.scenarios[result.worst - 1];
  EXPECT_NEAR(worst.objective, result.objective, 1e-9 * result.objective);
  rosbag::Bag bag(result.bag);
  std::vector<double> ends;
  for (const std::string topic :
       {"tuned/joint_states", "worst/tuned/joint_states", "worst/initial/joint_states"}) {
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    EXPECT_EQ(view.size(), 17U) << topic;
    for (const rosbag::MessageInstance& instance : view)
      if (instance.getTime() == view.getEndTime())
        ends.push_back(instance.instantiate<sensor_msgs::JointState>()->position.at(0));
  }
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_NE(ends[0], ends[1]) << "the mass of the run is not the nominal one";
  rosbag::View text(bag, rosbag::TopicQuery("worst/tuned/robot_description"));
  const RobotDescription robot =
      read_urdf({"worst", text.begin()->instantiate<std_msgs::String>()->data});
  EXPECT_EQ(robot.parameters[1].value, worst.values.at(0));
}

TEST_F(OptimizationJob, ACancelledOneKeepsItsBestPointAndIsRecorded) {
  const auto result =
      run(OptimizeGoal(), [&](const mechanism_codesign::OptimizationProgress& progress) {
        if (progress.evaluation == 2) cancel_ = true;
      }).result;
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.code, "cancelled");
  EXPECT_LE(result.objective, result.initial_objective);
  EXPECT_TRUE(std::filesystem::exists(result.bag));
}

TEST_F(OptimizationJob, CancelledBeforeTheFirstEvaluationItRecordsItsStart) {
  cancel_ = true;
  const OptimizationOutcome outcome = run();
  EXPECT_EQ(outcome.result.code, "cancelled");
  EXPECT_EQ(outcome.result.tuned, (std::vector<double>{0.5, 1.0}));
  EXPECT_TRUE(std::isnan(outcome.result.objective));
  rosbag::Bag bag(outcome.result.bag);
  for (const std::string topic : {"initial/joint_states", "tuned/joint_states"})
    EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery(topic)).size(), 11U);
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("optimization_progress")).size(), 0U);
}

TEST_F(OptimizationJob, TheBestPointIsOnDiskUntilTheBagIs) {
  std::set<unsigned> seen;
  const auto result =
      run(OptimizeGoal(), [&](const mechanism_codesign::OptimizationProgress& progress) {
        for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
          if (entry.path().string().find(".best.json") != std::string::npos)
            seen.insert(progress.evaluation);
      }).result;
  EXPECT_EQ(seen.size(), result.evaluations);
  const auto entries = std::filesystem::directory_iterator(directory_.path());
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 2) << "the bag and its folder alone";
}

TEST_F(OptimizationJob, TheFolderBesideTheBagReproducesTheObjective) {
  const auto result = run().result;
  ASSERT_TRUE(result.success) << result.message;
  const std::filesystem::path folder = std::filesystem::path(result.bag).replace_extension();
  const auto source = [&folder](const char* name) { return read_source((folder / name).string()); };
  const Problem again = load_problem(source("tuned.urdf"), {}, source("job_study.yaml"),
                                     read_result(source("result.json")));
  EXPECT_EQ(again.start(), Eigen::Map<const Eigen::VectorXd>(result.tuned.data(), 2));
  const Evaluation evaluation = Evaluator(again).evaluate(again.start(), true);
  EXPECT_NEAR(evaluation.objective, result.objective, 1e-12 * result.objective);
  const std::string convergence = source("convergence.csv").text;
  EXPECT_EQ(static_cast<unsigned>(std::count(convergence.begin(), convergence.end(), '\n')),
            result.evaluations + 1);
  for (const char* name : {"details.json", "initial.csv", "tuned.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST_F(OptimizationJob, AFolderThatCannotBeWrittenIsAWarning) {
  // In the way of the folder's convergence.csv, once its name is known.
  const auto result =
      run(OptimizeGoal(), [&](const mechanism_codesign::OptimizationProgress& progress) {
        std::filesystem::create_directories(directory_.path() / progress.job / "convergence.csv");
      }).result;
  EXPECT_TRUE(result.success) << result.message;
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings.back().code, "folder_incomplete");
  EXPECT_TRUE(std::filesystem::exists(result.bag));
}

TEST_F(OptimizationJob, ManyInOneSecondLeaveABagEach) {
  OptimizeGoal request;
  request.max_evaluations = 1;
  std::set<std::string> bags;
  for (int k = 0; k < 20; ++k) bags.insert(run(request).result.bag);
  EXPECT_EQ(bags.size(), 20U);
  for (const std::string& bag : bags) EXPECT_TRUE(std::filesystem::exists(bag)) << bag;
}

TEST_F(OptimizationJob, ADiskThatIsFullAtTheEndKeepsWhatWasComputedInTheReply) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto result = run().result;
    const bool is_told =
        result.code == "output_failed" &&
        result.message.find(": cannot be written: File too large") != std::string::npos;
    _exit(is_told && !result.success && result.bag.empty() && result.tuned.size() == 2 &&
                  result.objective < result.initial_objective
              ? 0
              : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  for (const auto& entry : std::filesystem::directory_iterator(directory_.path())) {
    const bool is_kept = entry.path().string().find(".best.") != std::string::npos ||
                         entry.path().extension() == ".jsonl";
    EXPECT_TRUE(is_kept) << entry.path();
  }
}

TEST_F(OptimizationJob, ABadRequestIsAnAnswerAndLeavesNothing) {
  OptimizeGoal request;
  request.algorithm = "newton_raphson";
  const auto result = run(request).result;
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.code, "bad_input");
  EXPECT_NE(result.message.find("newton_raphson"), std::string::npos) << result.message;
  EXPECT_TRUE(left_nothing());
}

TEST_F(OptimizationJob, AnOutputDirectoryThatCannotBeMadeIsAnAnswer) {
  const auto result =
      run_optimization(pendulum(), "", OptimizeGoal(), {"/dev/null/bags", 20.0}, {}, cancel_)
          .result;
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.code, "output_failed");
}

}  // namespace
}  // namespace codesign
