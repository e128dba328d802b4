// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The bags of optimizations of the studies in test/features.
#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "mechanism_codesign/Signals.h"
#include "paths.h"
#include "problem/load_problem.h"
#include "ros/jobs/job.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

std::vector<std::string> features() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/test/features"))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

class FeatureJob : public testing::TestWithParam<std::string> {};

/// The values of all messages of a topic, one row per message, each finite.
template <class Message>
std::vector<std::vector<double>> rows(const rosbag::Bag& bag, const std::string& topic,
                                      const std::vector<double> Message::*values) {
  std::vector<std::vector<double>> found;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const auto message = instance.instantiate<Message>();
    for (const double value : (*message).*values) EXPECT_TRUE(std::isfinite(value)) << topic;
    found.push_back((*message).*values);
  }
  return found;
}

TEST_P(FeatureJob, TheBagHoldsBothRunsWithTheSignalsOfTheStudy) {
  ros::Time::init();
  const TemporaryDirectory folder;
  const std::string base = source_dir() + "/test/features/" + GetParam();
  const Problem problem =
      load_problem(read_source(base + ".urdf"), {}, read_source(base + ".yaml"));
  const std::atomic<bool> cancel{false};
  const auto result =
      run_optimization(problem, "", {}, {folder.path().string(), 200.0}, {}, cancel).result;
  ASSERT_FALSE(result.bag.empty()) << result.message;
  EXPECT_LT(result.objective, result.initial_objective);
  const rosbag::Bag bag(result.bag);
  for (const std::string side : {"initial/", "tuned/"}) {
    const auto joints = rows(bag, side + "joint_states", &sensor_msgs::JointState::position);
    ASSERT_GT(joints.size(), 5U);
    EXPECT_NE(joints.front(), joints.back());
    const auto signals = rows(bag, side + "signals", &mechanism_codesign::Signals::value);
    ASSERT_EQ(signals.size(), joints.size());
    EXPECT_FALSE(signals.front().empty());
    EXPECT_NE(signals.front(), signals.back());
  }
}

INSTANTIATE_TEST_SUITE_P(Features, FeatureJob, testing::ValuesIn(features()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace codesign
