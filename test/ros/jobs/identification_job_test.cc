// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/job.h"

#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include <filesystem>
#include <fstream>

#include "identification/geared_arm.h"
#include "identification/swinging_arm.h"
#include "jobs/json.h"
#include "reading/urdf/urdf_reader.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

using mechanism_codesign::IdentificationProgress;
using mechanism_codesign::IdentifyGoal;

class IdentificationJobTest : public testing::Test {
 protected:
  IdentificationJobTest() {
    ros::Time::init();
    std::ofstream(folder_.path() / "data.csv") << SwingingRig().table();
  }

  IdentificationOutcome run(const IdentifyGoal& request = {}, const std::string& more = "",
                            const IdentificationObserver& observer = {}) {
    return run_identification(swinging_problem("{csv: data.csv}", more), folder_.path().string(),
                              request, {out(), 20.0}, observer, cancel_);
  }
  std::string out() const { return (folder_.path() / "out").string(); }
  static std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void expect_files(const IdentificationOutcome& outcome) {
    const auto& result = outcome.result;
    for (const std::string& path :
         {result.report, result.urdf, result.overlay, result.residuals, result.bag}) {
      EXPECT_TRUE(std::filesystem::is_regular_file(path)) << path;
      EXPECT_EQ(path.rfind(out() + "/" + result.job + ".", 0), 0U) << path;
    }
    std::ptrdiff_t count = std::distance(std::filesystem::directory_iterator(out()), {});
    EXPECT_EQ(count, 6) << "nothing else is left";
  }

  TemporaryDirectory folder_;
  std::atomic<bool> cancel_{false};
};

TEST_F(IdentificationJobTest, FindsTheRigsNumbersAndWritesAllFiles) {
  std::vector<IdentificationProgress> told;
  const IdentificationOutcome outcome =
      run({}, "  holdout: [{csv: data.csv, from: 2.0}]\n",
          [&](const auto& progress) { told.push_back(progress); });
  const auto& result = outcome.result;
  ASSERT_TRUE(result.success) << result.message;
  ASSERT_EQ(result.numbers.size(), 2U);
  EXPECT_EQ(result.numbers[0].name, "inertia");
  EXPECT_NEAR(result.numbers[0].value, 0.3, 1e-3);
  EXPECT_NEAR(result.numbers[1].value, 0.4, 1e-3);
  EXPECT_TRUE(result.numbers[0].determined);
  EXPECT_LT(result.numbers[0].low, result.numbers[0].high);
  EXPECT_TRUE(std::isnan(result.numbers[0].profile_low));
  EXPECT_EQ(result.rank, 2U);
  EXPECT_EQ(result.covariance.size(), 4U);
  EXPECT_EQ(result.values, (std::vector<double>{result.numbers[0].value, result.numbers[1].value}));
  ASSERT_EQ(result.data.size(), 1U);
  ASSERT_EQ(result.holdout.size(), 1U);
  EXPECT_EQ(result.data[0].joint, "hinge");
  EXPECT_LT(result.data[0].rms, 0.01 * result.data[0].start_rms);
  expect_files(outcome);
  const Json report = Json::parse(text_of(result.report));
  EXPECT_EQ(report["identified"]["inertia"]["value"], result.numbers[0].value);
  EXPECT_TRUE(report.contains("warnings"));
  EXPECT_EQ(read_urdf({"identified", text_of(result.urdf)}).parameters[0].value,
            result.numbers[0].value);
  EXPECT_EQ(outcome.identified_urdf, text_of(result.urdf));
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().stage, "reading");
  EXPECT_EQ(told.back().stage, "recording");
  EXPECT_EQ(told.back().seconds_left, 0.0);
  EXPECT_EQ(told.back().evaluation, result.evaluations);
}

TEST_F(IdentificationJobTest, TheBagHoldsWhatWasMeasuredBesideWhatTheModelSays) {
  rosbag::Bag bag(run().result.bag);
  std::vector<sensor_msgs::JointStateConstPtr> sides[2];
  const std::string topics[] = {"measured/joint_states", "identified/joint_states"};
  for (int side = 0; side < 2; ++side)
    for (const rosbag::MessageInstance& instance :
         rosbag::View(bag, rosbag::TopicQuery(topics[side])))
      sides[side].push_back(instance.instantiate<sensor_msgs::JointState>());
  ASSERT_EQ(sides[0].size(), 100U);  // 5 s at 20 a second
  ASSERT_EQ(sides[1].size(), 100U);
  const SwingingRig rig;
  for (std::size_t k = 2; k < 99; ++k) {
    // Four samples at the ends are not fitted.
    const double t = 0.02 + 0.05 * static_cast<double>(k);
    EXPECT_NEAR(sides[0][k]->effort.at(0), rig.torque(t), 1e-5);
    EXPECT_NEAR(sides[1][k]->effort.at(0), rig.torque(t), 1e-2);
    EXPECT_NEAR(sides[1][k]->position.at(0), rig.position(t), 1e-5);
  }
}

TEST_F(IdentificationJobTest, ARequestChoosesParametersAndStarts) {
  IdentifyGoal request;
  request.parameters = {"viscous"};
  request.start = {2.0};
  request.max_evaluations = 7;
  std::uint32_t most = 0;
  const auto result =
      run(request, "", [&](const auto& progress) { most = std::max(most, progress.of); }).result;
  ASSERT_TRUE(result.success) << result.message;
  ASSERT_EQ(result.numbers.size(), 1U);
  EXPECT_EQ(result.numbers[0].start, 2.0);
  EXPECT_EQ(most, 7U);
  EXPECT_EQ(result.values.at(0), 0.1) << "the inertia stays as the model has it";
}

TEST_F(IdentificationJobTest, CancelledItKeepsTheBestPointAndItsFiles) {
  IdentifyGoal request;
  request.start = {4.0, 9.0};
  request.parameters = {"inertia", "viscous"};
  const IdentificationOutcome outcome =
      run(request, "  intervals: {profiles: true}\n",
          [&](const auto& progress) { cancel_ = progress.evaluation >= 2; });
  EXPECT_EQ(outcome.result.code, "cancelled");
  EXPECT_EQ(outcome.result.termination, "cancelled");
  ASSERT_EQ(outcome.result.numbers.size(), 2U);
  EXPECT_LT(outcome.result.data.at(0).rms, outcome.result.data.at(0).start_rms);
  EXPECT_GT(outcome.result.numbers[0].deviation, 0.0);
  expect_files(outcome);
  const Json report = Json::parse(text_of(outcome.result.report));
  EXPECT_EQ(report["error"]["code"], "cancelled");
  EXPECT_EQ(report["identified"]["inertia"]["value"], outcome.result.numbers[0].value);
}

TEST_F(IdentificationJobTest, CancelledWhileProfilesAreFoundItIsCancelled) {
  const IdentificationOutcome outcome =
      run({}, "  intervals: {profiles: true}\n",
          [&](const auto& progress) { cancel_ = progress.stage == "profiling"; });
  EXPECT_EQ(outcome.result.code, "cancelled");
  EXPECT_NEAR(outcome.result.numbers.at(0).value, 0.3, 1e-3);
  expect_files(outcome);
}

TEST_F(IdentificationJobTest, CancelledBeforeTheFirstEvaluationItLeavesNothing) {
  cancel_ = true;
  const IdentificationOutcome outcome = run();
  EXPECT_EQ(outcome.result.code, "cancelled");
  EXPECT_TRUE(outcome.result.numbers.empty());
  EXPECT_TRUE(std::filesystem::is_empty(out()));
}

TEST_F(IdentificationJobTest, CancelledWhileItReadsABagItLeavesNothing) {
  {
    rosbag::Bag bag((folder_.path() / "data.bag").string(), rosbag::bagmode::Write);
    for (int k = 0; k < 100; ++k)
      bag.write("joint_states", ros::Time(1.0 + 0.01 * k), sensor_msgs::JointState());
  }
  const Problem problem = swinging_problem("{bag: data.bag, topic: joint_states}");
  const auto cancel_at_once = [this](const IdentificationProgress& progress) {
    cancel_ = progress.stage == "reading";
  };
  const auto result = run_identification(problem, folder_.path().string(), {}, {out(), 20.0},
                                         cancel_at_once, cancel_)
                          .result;
  EXPECT_EQ(result.code, "cancelled") << result.message;
  EXPECT_TRUE(std::filesystem::is_empty(out()));
}

TEST_F(IdentificationJobTest, BadInputIsAnsweredWithItsPlace) {
  IdentifyGoal request;
  request.parameters = {"inertia", "viscos"};
  EXPECT_EQ(run(request).result.code, "bad_input");
  EXPECT_NE(run(request).result.message.find("viscous"), std::string::npos);
  request.parameters = {"inertia"};
  request.start = {1.0, 2.0};
  EXPECT_EQ(run(request).result.code, "bad_input");
  std::ofstream(folder_.path() / "data.csv", std::ios::app) << "4.0,0,0,0\n";
  const auto result = run().result;
  EXPECT_EQ(result.code, "bad_input");
  EXPECT_NE(result.message.find("data.csv:1003"), std::string::npos) << result.message;
  EXPECT_TRUE(std::filesystem::is_empty(out()));
}

TEST_F(IdentificationJobTest, AStudyWithoutRecordingsIsBadInput) {
  const Problem problem =
      load_problem({"arm.urdf", kSwingingArm}, {}, {"study.yaml", "duration: 1.0\n"});
  const auto result = run_identification(problem, "", {}, {out(), 20.0}, {}, cancel_).result;
  EXPECT_EQ(result.code, "bad_input");
  EXPECT_NE(result.message.find("identify"), std::string::npos) << result.message;
}

TEST_F(IdentificationJobTest, AFileThatCannotBeWrittenCostsThatFileAlone) {
  // A file in place of the folder: nothing can be written, and nothing is computed for nothing.
  std::ofstream(out()) << "in the way";
  const auto result = run().result;
  EXPECT_EQ(result.code, "output_failed");
  EXPECT_NE(result.message.find(out()), std::string::npos) << result.message;
}

/// Writes a recording as the joint states of a robot whose topic has positions and efforts.
void write_joint_states(const std::string& path, const JointRecording& recording) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  sensor_msgs::JointState message;
  for (const JointSamples& joint : recording.joints) message.name.push_back(joint.joint);
  message.position.resize(message.name.size());
  message.effort.resize(message.name.size());
  for (std::size_t k = 0; k < recording.times.size(); ++k) {
    message.header.stamp = ros::Time(100.0 + recording.times[k]);
    for (std::size_t joint = 0; joint < message.name.size(); ++joint) {
      message.position[joint] = recording.joints[joint].position[k];
      message.effort[joint] = recording.joints[joint].effort[k];
    }
    bag.write("/joint_states", message.header.stamp, message);
  }
}

TEST_F(IdentificationJobTest, OfABagFindsTheLossesOfAGearFromMotorsAlone) {
  write_joint_states((folder_.path() / "run.bag").string(),
                     with_noise(clean_geared_recording(), 3));
  const auto result = run_identification(geared_problem("{bag: run.bag, topic: /joint_states}"),
                                         folder_.path().string(), {}, {out(), 20.0}, {}, cancel_)
                          .result;
  ASSERT_TRUE(result.success) << result.message;
  ASSERT_EQ(result.numbers.size(), kGearedTruth.size());
  std::map<std::string, double> found;
  for (const auto& number : result.numbers) {
    found[number.name] = number.value;
    EXPECT_TRUE(number.determined) << number.name;
  }
  expect_geared_truth(found, "from a bag");
}

}  // namespace
}  // namespace codesign
