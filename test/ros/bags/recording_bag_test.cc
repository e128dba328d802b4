// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_files.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "fuzz/damage.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

/// Writes bags of 30 messages at 100 Hz, stamped 2 ms before they are received, 1 s after the bag's
/// first message.
class RecordedStates : public testing::Test {
 protected:
  using Change = std::function<void(int k, sensor_msgs::JointState* message)>;

  RecordedStates() {
    description_.is_bag = true;
    description_.file = "states.bag";
    description_.topic = "/joint_states";
    description_.element = "identify.data[0]";
    description_.where = {"study.yaml", 4};
  }

  std::string path() const { return (directory_.path() / "states.bag").string(); }

  /// @param change of message k before it is written
  void write(const Change& change = {}, const std::string& topic = "/joint_states",
             rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    rosbag::Bag bag(path(), rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(2000);
    bag.write("/words", ros::Time(100.0), std_msgs::String());
    for (int k = 0; k < 30; ++k) {
      const ros::Time received = ros::Time(101.0) + ros::Duration(0.01 * k);
      sensor_msgs::JointState message;
      message.header.stamp = received - ros::Duration(0.002);
      message.name = {"elbow", "unknown", "hinge"};
      message.position = {0.1 * k, 7.0, -0.1 * k};
      message.effort = {1.0 + k, 7.0, 2.0 + k};
      if (change) change(k, &message);
      bag.write(topic, received, message);
    }
    bag.close();
  }
  /// The bytes of the bag.
  std::string bytes() const {
    std::ostringstream all;
    all << std::ifstream(path(), std::ios::binary).rdbuf();
    return all.str();
  }
  void set_bytes(const std::string& bytes) const {
    std::ofstream(path(), std::ios::binary) << bytes;
  }
  JointRecording read() {
    return read_recording_bag(description_, path(), {"hinge", "elbow", "wrist"}, &warnings_);
  }
  InputFault fault() {
    try {
      read();
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 4);
      return error.fault();
    }
    ADD_FAILURE() << "accepted";
    return {};
  }
  void expect_message(const std::string& words) {
    const std::string message = fault().message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  void expect_warning(const std::string& code, const std::string& words) {
    warnings_.clear();
    read();
    ASSERT_EQ(warnings_.size(), 1U);
    EXPECT_EQ(warnings_[0].code, code);
    EXPECT_NE(warnings_[0].message.find(words), std::string::npos) << warnings_[0].message;
  }

  TemporaryDirectory directory_;
  RecordingDescription description_;
  Warnings warnings_;
};

TEST_F(RecordedStates, AreReadByJoint) {
  write();
  const JointRecording recording = read();
  EXPECT_EQ(recording.topic, "/joint_states");
  ASSERT_EQ(recording.times.size(), 30U);
  EXPECT_NEAR(recording.times[0], 1.0, 1e-9);
  EXPECT_NEAR(recording.times[29], 1.29, 1e-9);
  EXPECT_EQ(recording.places[3], 4U);
  ASSERT_EQ(recording.joints.size(), 2U);
  EXPECT_EQ(recording.joints[0].joint, "hinge") << "the order of the model, not of the alphabet";
  EXPECT_DOUBLE_EQ(recording.find("hinge")->position[3], -0.1 * 3);
  EXPECT_EQ(recording.find("elbow")->effort[3], 4.0);
  EXPECT_TRUE(recording.find("elbow")->velocity.empty());
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(RecordedStates, ATopicIsFoundWithOrWithoutItsSlash) {
  write({}, "joint_states");
  EXPECT_EQ(read().topic, "joint_states");
  description_.topic = "joint_states";
  write();
  EXPECT_EQ(read().topic, "/joint_states");
}

TEST_F(RecordedStates, WhatIsNotThereIsSaid) {
  write();
  description_.topic = "/joint_state";
  expect_message("no message on this topic, did you mean \"/joint_states\"");
  EXPECT_EQ(fault().allowed, "/joint_states (sensor_msgs/JointState), /words (std_msgs/String)");
  EXPECT_EQ(fault().element, "identify.data[0].topic");
  description_.topic = "/words";
  expect_message("holds no joint states but std_msgs/String");
  std::filesystem::remove(path());
  EXPECT_EQ(fault().element, "identify.data[0].bag");
  expect_message("the bag cannot be read");
}

TEST_F(RecordedStates, ABagThatIsStillRecordedIsSaidToBe) {
  write();
  std::filesystem::rename(path(), path() + ".active");
  EXPECT_NE(fault().allowed.find("states.bag.active is there"), std::string::npos)
      << fault().allowed;
}

TEST_F(RecordedStates, OfAnotherRobotAreRefused) {
  write([](int, sensor_msgs::JointState* message) { message->name = {"left", "right", "front"}; });
  expect_message("name no joint of the model, but front, left, right; a bag of another robot?");
  EXPECT_EQ(fault().allowed, "hinge, elbow, wrist");
}

TEST_F(RecordedStates, JointsMayChangePlaces) {
  write([](int k, sensor_msgs::JointState* message) {
    if (k % 2 == 0) return;
    message->name = {"hinge", "elbow"};
    message->position = {-0.1 * k, 0.1 * k};
    message->effort = {2.0 + k, 1.0 + k};
  });
  const JointRecording recording = read();
  ASSERT_EQ(recording.times.size(), 30U);
  for (std::size_t k = 0; k < 30; ++k)
    EXPECT_DOUBLE_EQ(recording.find("elbow")->position[k], 0.1 * static_cast<double>(k));
}

TEST_F(RecordedStates, OfSeveralPublishersTheOneWithMostJointsCounts) {
  write([](int k, sensor_msgs::JointState* message) {
    if (k % 3 != 0) return;
    message->name = {"wrist"};
    message->position = {5.0};
    message->effort = {5.0};
  });
  expect_warning("recording_joints_left_out", "name wrist, which are left out");
  EXPECT_EQ(read().times.size(), 20U);
}

TEST_F(RecordedStates, ArraysMustFitTheNames) {
  write([](int k, sensor_msgs::JointState* message) {
    if (k == 7) message->velocity = {1.0};
  });
  expect_message("3 names, and an array of 1 numbers, message 8 on /joint_states");
  write([](int k, sensor_msgs::JointState* message) {
    if (k == 7) message->effort.clear();
  });
  expect_message("the array of efforts is empty, but was not in the messages before, message 8");
}

TEST_F(RecordedStates, WhatIsNotANumberThroughoutWasNotMeasured) {
  write([](int, sensor_msgs::JointState* message) {
    message->effort.assign(3, std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_TRUE(read().find("hinge")->effort.empty());
  write([](int k, sensor_msgs::JointState* message) {
    if (k == 7) message->effort[2] = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_TRUE(std::isnan(read().find("hinge")->effort[7]));
  write([](int, sensor_msgs::JointState* message) { message->effort[2] = 0.0; });
  expect_warning("recording_all_zero", "the effort of hinge is zero throughout");
}

TEST_F(RecordedStates, StampsAreCheckedAgainstTheTimesOfReception) {
  write([](int k, sensor_msgs::JointState* message) {
    message->header.stamp += ros::Duration(k < 20 ? 0.0 : 3600.0);
  });
  expect_warning("recording_clock",
                 "message 21 was received -3600 s after its stamp, the one before 0.002 s");
  EXPECT_NEAR(read().times[29], 3601.29, 1e-6);
  description_.stamp = StampKind::kReceive;
  EXPECT_NEAR(read().times[29], 1.29, 1e-9);
  description_.stamp = StampKind::kHeader;
  write(
      [](int, sensor_msgs::JointState* message) { message->header.stamp -= ros::Duration(90.0); });
  expect_warning("recording_clock", "message 1 was received 90.002 s after its stamp");
  EXPECT_NEAR(read().times[0], 1.0, 1e-9);
  write([](int, sensor_msgs::JointState* message) { message->header.stamp = ros::Time(); });
  expect_message("the stamp of the header is zero, message 1");
}

TEST_F(RecordedStates, CompressionMakesNoDifference) {
  write();
  const JointRecording plain = read();
  for (const auto compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    write({}, "/joint_states", compression);
    const JointRecording packed = read();
    EXPECT_EQ(packed.times, plain.times);
    EXPECT_EQ(packed.find("elbow")->position, plain.find("elbow")->position);
  }
}

TEST_F(RecordedStates, AWrongLengthIsNamedWithItsPlace) {
  write();
  const std::string whole = bytes();
  std::string damaged = whole;
  // The header of a message begins with its kind: a length of 4, then op=2. One changed byte makes
  // the length 262148.
  const std::string kind("\4\0\0\0op=\2", 8);
  const std::size_t place = whole.find(kind);
  ASSERT_NE(place, std::string::npos);
  damaged[place + 2] = 4;
  set_bytes(damaged);
  expect_message("a header's field of 262148 bytes");
  expect_message("at byte " + std::to_string(place + 4));
  set_bytes(whole.substr(0, whole.size() / 2));
  expect_message("it is cut: its index is at byte ");
  EXPECT_NE(fault().allowed.find("rosbag reindex"), std::string::npos);
  set_bytes("no bag");
  expect_message("it is not a bag");
  set_bytes("#ROSBAG V1.2\n");
  expect_message("`rosbag fix`");
}

// rosbag_storage crashes, hangs or asks for gigabytes at some of these.
TEST_F(RecordedStates, OfAnyBytesAreReadOrRefused) {
  fuzz::Dice dice(24);
  int refused = 0;
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    write({}, "/joint_states", compression);
    const std::string whole = bytes();
    for (int k = 0; k < 120; ++k) {
      set_bytes(fuzz::damage(whole, &dice));
      try {
        read();
      } catch (const InputError& error) {
        EXPECT_EQ(error.fault().element.rfind("identify.data[0]", 0), 0U);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace codesign
