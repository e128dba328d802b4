// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/job_bag.h"

#include <gtest/gtest.h>
#include <mechanism_codesign/Residuals.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <map>

#include "jobs/files.h"
#include "ros/sample_frame.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

/// Two recordings of one second, the first with frames at 7 and 8 s of its clock and three
/// residuals, the holdout with two of each.
IdentificationShow sample_show() {
  IdentificationShow show;
  show.study = "identify: {}";
  show.json = "{}";
  show.urdf = "<robot name='identified'/>";
  show.joints = {"hinge"};
  show.motion.names = sample_names();
  show.motion.link_parents = sample_parents();
  show.motion.joints = {{1, 1, Eigen::Vector3d::UnitX(), true}};
  for (const double start : {7.0, 0.0}) {
    const std::vector<Frame> frames{sample_frame(start), sample_frame(start + 1.0)};
    show.motion.recordings.push_back(
        {start > 0.0 ? "identify.data[0]" : "identify.holdout[0]", frames, frames, {}});
  }
  show.data = {{3},
               {7.0, 7.5, 8.0},
               Eigen::MatrixXd::Constant(3, 1, 2.0),
               Eigen::MatrixXd::Constant(3, 1, 2.5)};
  show.holdout = {
      {2}, {0.0, 1.0}, Eigen::MatrixXd::Constant(2, 1, 1.0), Eigen::MatrixXd::Constant(2, 1, 0.75)};
  return show;
}

class IdentificationBag : public testing::Test {
 protected:
  void write(const IdentificationAnswer* answer = nullptr) {
    path_ = (directory_.path() / "a.bag").string();
    write_identification_bag(path_, sample_show(), answer);
    bag_.open(path_, rosbag::bagmode::Read);
  }
  std::map<std::string, int> counts() {
    std::map<std::string, int> counts;
    rosbag::View view(bag_);
    for (const rosbag::MessageInstance& instance : view) ++counts[instance.getTopic()];
    return counts;
  }
  template <class Message>
  std::vector<boost::shared_ptr<Message>> read(const std::string& topic) {
    std::vector<boost::shared_ptr<Message>> messages;
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view)
      messages.push_back(instance.instantiate<Message>());
    return messages;
  }

  TemporaryDirectory directory_;
  std::string path_;
  rosbag::Bag bag_;
};

TEST_F(IdentificationBag, HoldsBothSidesAndEverythingAroundThem) {
  write();
  std::map<std::string, int> expected{{"study", 1},
                                      {"identification", 1},
                                      {"measured/robot_description", 1},
                                      {"identified/robot_description", 1},
                                      {"tf_static", 1},
                                      {"labels", 2},
                                      {"measured/joint_states", 4},
                                      {"tf", 8},
                                      {"efforts", 4},
                                      {"residuals", 5},
                                      {"scene", 1}};
  for (const char* topic : {"joint_states", "joint_friction", "controller_states", "loop_errors",
                            "signals", "friction_markers"})
    expected[std::string("identified/") + topic] = 4;
  EXPECT_EQ(counts(), expected);
  EXPECT_EQ(read<std_msgs::String>("measured/robot_description").at(0)->data,
            "<robot name='identified'/>");
}

TEST_F(IdentificationBag, RecordingsFollowOneAnother) {
  write();
  rosbag::View view(bag_);
  EXPECT_EQ(view.getBeginTime(), ros::Time(1.0));
  EXPECT_EQ(view.getEndTime(), ros::Time(3.5));
  std::vector<double> stamps;
  for (const auto& state : read<sensor_msgs::JointState>("identified/joint_states"))
    stamps.push_back(state->header.stamp.toSec());
  EXPECT_EQ(stamps, (std::vector<double>{1.0, 2.0, 2.5, 3.5}));
  const auto residuals = read<mechanism_codesign::Residuals>("residuals");
  EXPECT_EQ(residuals[1]->header.stamp, ros::Time(1.5));
  EXPECT_EQ(residuals[1]->time, 7.5);
  EXPECT_EQ(residuals[1]->recording, "identify.data[0]");
  EXPECT_EQ(residuals[1]->name, std::vector<std::string>{"hinge"});
  EXPECT_EQ(residuals[1]->residual, std::vector<double>{0.5});
  EXPECT_EQ(residuals[4]->recording, "identify.holdout[0]");
  EXPECT_EQ(residuals[4]->header.stamp, ros::Time(3.5));
  EXPECT_EQ(residuals[4]->residual, std::vector<double>{-0.25});
}

TEST_F(IdentificationBag, BothSidesHaveFramesOfTheirOwn) {
  write();
  std::map<std::string, std::string> parents;
  for (const char* topic : {"tf", "tf_static"})
    for (const auto& message : read<tf2_msgs::TFMessage>(topic))
      for (const auto& transform : message->transforms)
        parents[transform.child_frame_id] = transform.header.frame_id;
  for (const std::string side : {"measured", "identified"}) {
    EXPECT_EQ(parents.at(side), "world");
    EXPECT_EQ(parents.at(side + "/ground"), side);
    EXPECT_EQ(parents.at(side + "/cart"), side + "/ground");
    EXPECT_EQ(parents.at(side + "/plate"), side + "/cart") << "a tree, as the node publishes it";
  }
}

TEST_F(IdentificationBag, OfANodeItHoldsRequestAndResult) {
  IdentificationAnswer answer;
  answer.request.max_evaluations = 9;
  answer.result.rank = 3;
  answer.progress.resize(2);
  write(&answer);
  EXPECT_EQ(read<mechanism_codesign::IdentifyGoal>("request").at(0)->max_evaluations, 9U);
  EXPECT_EQ(read<mechanism_codesign::IdentifyResult>("result").at(0)->rank, 3U);
  EXPECT_EQ(counts()["identification_progress"], 2);
}

TEST_F(IdentificationBag, ManyResidualsAreThinned) {
  IdentificationShow show = sample_show();
  show.data.lengths = {25000};
  show.data.times.clear();
  for (int row = 0; row < 25000; ++row) show.data.times.push_back(1e-4 * row);
  show.data.recorded = show.data.computed = Eigen::MatrixXd::Zero(25000, 1);
  path_ = (directory_.path() / "c.bag").string();
  write_identification_bag(path_, show, nullptr);
  bag_.open(path_, rosbag::bagmode::Read);
  EXPECT_EQ(counts()["residuals"], 8334 + 1);
}

TEST_F(IdentificationBag, WithoutFramesItHoldsTheResidualsAllTheSame) {
  IdentificationShow show = sample_show();
  for (ComparedRecording& recording : show.motion.recordings) {
    recording.measured.clear();
    recording.model.clear();
  }
  path_ = (directory_.path() / "b.bag").string();
  write_identification_bag(path_, show, nullptr);
  bag_.open(path_, rosbag::bagmode::Read);
  EXPECT_EQ(counts()["residuals"], 5);
  EXPECT_EQ(counts().count("tf"), 0U);
}

TEST_F(IdentificationBag, NeverReplacesAFile) {
  write();
  EXPECT_THROW(write_identification_bag(path_, sample_show(), nullptr), OutputError);
}

}  // namespace
}  // namespace codesign
