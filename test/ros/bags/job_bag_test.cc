// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/job_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <map>

#include "jobs/files.h"
#include "mechanism_codesign/Event.h"
#include "mechanism_codesign/Scene.h"
#include "ros/sample_frame.h"
#include "ros/scene/frame_messages.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

JobRecord sample_record() {
  JobRecord record;
  RecordedRun run{sample_names(),
                  {sample_frame(0.0), sample_frame(0.5), sample_frame(1.0)},
                  {},
                  sample_parents()};
  run.frames[1].objective = 1.5;
  run.events = {{{0.25, "loads[0].effort", "rail", "t < 0.25", false, true}, 1},
                {{0.4, "loads[0].effort", "rail", "t < 0.4", true, false}, 1},
                {{1.5, "loads[0].effort", "rail", "t < 1.5", true, false}, 1}};
  record.nominal = {{"<robot name='before'/>", run}, {"<robot name='after'/>", run}};
  record.trials.resize(5);
  record.request.max_evaluations = 9;
  record.result.objective = 0.25;
  record.result.initial_objective = 0.5;
  record.study = "duration: 1.0";
  record.study_files = {"{\"names\": []}", "second"};
  return record;
}

class JobBag : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (directory_.path() / "a.bag").string();
    write_bag(path_, sample_record());
    bag_.open(path_, rosbag::bagmode::Read);
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

TEST_F(JobBag, HoldsBothRunsAndEverythingAroundThem) {
  std::map<std::string, int> counts;
  rosbag::View view(bag_);
  for (const rosbag::MessageInstance& instance : view) ++counts[instance.getTopic()];
  std::map<std::string, int> expected{{"study", 1},
                                      {"study_files", 2},
                                      {"request", 1},
                                      {"result", 1},
                                      {"optimization_progress", 5},
                                      {"tf_static", 1},
                                      {"labels", 1},
                                      {"scene", 1},
                                      {"tf", 6},
                                      {"caption", 3}};
  for (const char* topic : {"tf_static", "labels", "scene"})
    expected[std::string("overlay/") + topic] = 1;
  for (const std::string side : {"initial/", "tuned/"}) {
    expected[side + "robot_description"] = 1;
    for (const char* topic : {"joint_states", "joint_friction", "controller_states", "loop_errors",
                              "signals", "friction_markers"})
      expected[side + topic] = 3;
    for (const char* topic : {"events", "event_markers"}) expected[side + topic] = 2;
  }
  EXPECT_EQ(counts, expected);
}

TEST_F(JobBag, ContentsSurvive) {
  EXPECT_EQ(read<std_msgs::String>("initial/robot_description").at(0)->data,
            "<robot name='before'/>");
  EXPECT_EQ(read<std_msgs::String>("tuned/robot_description").at(0)->data, "<robot name='after'/>");
  EXPECT_EQ(read<std_msgs::String>("study").at(0)->data, "duration: 1.0");
  EXPECT_EQ(read<std_msgs::String>("study_files").at(0)->data, "{\"names\": []}");
  EXPECT_EQ(read<std_msgs::String>("study_files").at(1)->data, "second");
  EXPECT_EQ(read<mechanism_codesign::OptimizeGoal>("request").at(0)->max_evaluations, 9U);
  EXPECT_EQ(read<mechanism_codesign::OptimizeResult>("result").at(0)->objective, 0.25);
}

// The third event is behind the last frame.
TEST_F(JobBag, EventsStandAtTheirLinksAtTheirTimes) {
  const auto events = read<mechanism_codesign::Event>("tuned/events");
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0]->header.stamp, ros::Time(1.25));
  EXPECT_EQ(events[0]->expression, "t < 0.25");
  EXPECT_EQ(events[0]->object, "rail");
  EXPECT_TRUE(events[0]->jump);
  EXPECT_FALSE(events[0]->rising);
  const auto markers = read<visualization_msgs::MarkerArray>("tuned/event_markers");
  ASSERT_EQ(markers.size(), 2U);
  const auto &first = markers[0]->markers.at(0), &second = markers[1]->markers.at(0);
  EXPECT_EQ(first.text, "t < 0.25 falling");
  EXPECT_EQ(first.header.frame_id, "tuned/ground");
  EXPECT_EQ(first.header.stamp, ros::Time(1.25));
  EXPECT_NE(first.id, second.id);
  EXPECT_GT(first.lifetime, ros::Duration(0.0));
  const auto height = [](const visualization_msgs::Marker& marker) {
    return Eigen::Vector3d(marker.pose.position.x, marker.pose.position.y, marker.pose.position.z);
  };
  EXPECT_GE((height(second) - height(first)).norm(), 0.99 * first.scale.z) << "one above the other";
}

TEST_F(JobBag, LinksHangOnTheirParentsAsInTheNode) {
  for (const std::string side : {"initial", "tuned"}) {
    std::map<std::string, std::string> parents;
    for (const auto& message : read<tf2_msgs::TFMessage>("tf"))
      for (const auto& transform : message->transforms)
        parents[transform.child_frame_id] = transform.header.frame_id;
    EXPECT_EQ(parents.at(side + "/ground"), side);
    EXPECT_EQ(parents.at(side + "/cart"), side + "/ground");
    EXPECT_EQ(parents.at(side + "/plate"), side + "/cart");
  }
}

TEST_F(JobBag, RecordedTimeStartsAtOneSecondAndAgreesWithTheStamps) {
  rosbag::View view(bag_);
  EXPECT_EQ(view.getBeginTime(), ros::Time(1.0));
  EXPECT_EQ(view.getEndTime(), ros::Time(2.0));
  const auto states = read<sensor_msgs::JointState>("tuned/joint_states");
  EXPECT_EQ(states.at(1)->header.stamp, ros::Time(1.5));
  EXPECT_EQ(states.at(1)->header.frame_id, "tuned/ground");
  const auto progress = read<mechanism_codesign::OptimizationProgress>("optimization_progress");
  EXPECT_EQ(progress.at(1)->header.stamp, ros::Time(1.25));
}

TEST_F(JobBag, SideBySideTheMechanismsStandApartAndLaidOverEachOtherInOnePlace) {
  for (const std::string place : {"", "overlay/"}) {
    const auto transforms = read<tf2_msgs::TFMessage>(place + "tf_static").at(0)->transforms;
    ASSERT_EQ(transforms.size(), 3U);
    EXPECT_EQ(transforms[0].child_frame_id, "initial");
    EXPECT_EQ(transforms[1].child_frame_id, "tuned");
    EXPECT_EQ(transforms[2].child_frame_id, "caption");
    const auto &initial = transforms[0].transform.translation,
               &tuned = transforms[1].transform.translation;
    EXPECT_EQ(std::hypot(initial.x - tuned.x, initial.y - tuned.y) < 1e-12, place == "overlay/");
  }
  const auto apart = read<mechanism_codesign::Scene>("scene").at(0),
             over = read<mechanism_codesign::Scene>("overlay/scene").at(0);
  EXPECT_EQ(apart->header.frame_id, "world");
  EXPECT_GT(apart->distance, over->distance);
  EXPECT_EQ(read<visualization_msgs::MarkerArray>("labels").at(0)->markers.size(), 2U);
  const auto label = read<visualization_msgs::MarkerArray>("overlay/labels").at(0)->markers.at(0);
  EXPECT_EQ(label.text, "tuned, objective 0.25; ghost: initial, objective 0.5");
}

TEST_F(JobBag, TheTextTellsTimeAndBothObjectivesSoFar) {
  const auto captions = read<visualization_msgs::MarkerArray>("caption");
  ASSERT_EQ(captions.at(1)->markers.size(), 3U);
  EXPECT_EQ(captions.at(1)->markers[0].text, "t = 0.5 s, objective so far: initial 1.5 tuned 1.5");
  EXPECT_EQ(captions.at(1)->markers[0].header.frame_id, "caption");
  EXPECT_EQ(captions.at(1)->markers[1].text.substr(0, 14), "friction force");
}

TEST_F(JobBag, DescriptionsAndPlacesAreLatched) {
  rosbag::View view(bag_);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const auto latching = connection->header->find("latching");
    const bool is_latched = latching != connection->header->end() && latching->second == "1";
    const bool is_run = connection->topic == "tf" || connection->topic == "caption" ||
                        connection->datatype.find("Joint") != std::string::npos ||
                        connection->topic.find("_states") != std::string::npos ||
                        connection->topic.find("_errors") != std::string::npos ||
                        connection->topic.find("_markers") != std::string::npos ||
                        connection->datatype == "mechanism_codesign/Signals" ||
                        connection->datatype == "mechanism_codesign/Event";
    EXPECT_NE(is_latched, is_run) << connection->topic;
  }
}

TEST_F(JobBag, TheWorstRunHasTheTopicsOfTheNominalOneBelowItsName) {
  JobRecord record = sample_record();
  record.worst = record.nominal;
  record.worst->tuned.urdf = "<robot name='worst'/>";
  const std::string path = (directory_.path() / "worst.bag").string();
  write_bag(path, record);
  std::map<std::string, std::size_t> counts, nominal;
  rosbag::Bag bag(path);
  rosbag::View view(bag), before(bag_);
  for (const rosbag::MessageInstance& instance : view) ++counts[instance.getTopic()];
  for (const rosbag::MessageInstance& instance : before) ++nominal[instance.getTopic()];
  std::size_t below = 0;
  for (const auto& [topic, count] : counts) {
    const bool is_worst = topic.compare(0, 6, "worst/") == 0;
    EXPECT_EQ(count, nominal[is_worst ? topic.substr(6) : topic]) << topic;
    if (is_worst) ++below;
  }
  EXPECT_EQ(below, 2U * 9U + 2U)
      << "six topics, two of events and the description of each design, tf and caption";
  rosbag::View text(bag, rosbag::TopicQuery("worst/tuned/robot_description"));
  EXPECT_EQ(text.begin()->instantiate<std_msgs::String>()->data, "<robot name='worst'/>");
}

TEST_F(JobBag, NothingUnfinishedIsLeft) {
  EXPECT_FALSE(std::filesystem::exists(path_ + ".active"));
}

TEST(WriteBag, AFullOrMissingDirectoryIsAnError) {
  EXPECT_THROW(write_bag("/nonexistent_directory/a.bag", sample_record()), OutputError);
}

TEST(ProgressMessage, OfAFailedTrialSaysWhy) {
  Trial trial;
  trial.evaluation = 7;
  trial.iteration = 3;
  trial.status = {StatusCode::kAssemblyFailed, 0.0, "the rod is too short"};
  trial.rho = Eigen::Vector2d(0.25, 0.5);
  trial.best_objective = 1.5;
  trial.start = 2;
  const auto message = optimization_progress(trial, "arm_1", {"a", "b"});
  EXPECT_EQ(message.job, "arm_1");
  EXPECT_EQ(message.evaluation, 7U);
  EXPECT_EQ(message.iteration, 3U);
  EXPECT_EQ(message.code, "assembly_failed");
  EXPECT_EQ(message.message, "the rod is too short");
  EXPECT_EQ(message.parameters, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(message.values, (std::vector<double>{0.25, 0.5}));
  EXPECT_TRUE(message.gradient.empty());
  EXPECT_EQ(message.best_objective, 1.5);
  EXPECT_EQ(message.search, 2U);
}

}  // namespace
}  // namespace codesign
