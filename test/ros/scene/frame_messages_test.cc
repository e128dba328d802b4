// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/frame_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "codegen/traced.h"
#include "description/robot.h"
#include "observation/observer.h"
#include "ros/sample_frame.h"

namespace codesign {
namespace {

TEST(FrameMessages, EveryTopicOnceAndAllOfOneInstant) {
  const MessageContext context{ros::Time(12.5), "ground"};
  const FrameMessages messages(sample_names(), sample_frame(2.0), context, MarkerStyle());
  std::vector<std::string> topics;
  messages.visit([&topics](const std::string& topic, const auto&) { topics.push_back(topic); });
  EXPECT_EQ(topics, (std::vector<std::string>{"joint_states", "joint_friction", "controller_states",
                                              "loop_errors", "signals", "friction_markers"}));
  EXPECT_EQ(messages.joint_states.header.stamp, context.stamp);
  EXPECT_EQ(messages.joint_friction.header.stamp, context.stamp);
  EXPECT_EQ(messages.controller_states.header.stamp, context.stamp);
  EXPECT_EQ(messages.loop_errors.header.stamp, context.stamp);
  EXPECT_EQ(messages.joint_states.name.size(), 2U) << "the joints of the tree";
  EXPECT_EQ(messages.friction_markers.markers.size(), 2U);
  for (const auto& marker : messages.friction_markers.markers) {
    EXPECT_EQ(marker.header.stamp, context.stamp);
    EXPECT_EQ(marker.header.frame_id, "ground");
  }
}

const MessageContext kContext{ros::Time(12, 500), "ground"};

using Numbers = std::vector<double>;
using Names = std::vector<std::string>;

TEST(Conversions, JointStatesHoldTheTreeJointsAndNoLoop) {
  const auto message = joint_states(sample_names(), sample_frame(0.0), kContext);
  EXPECT_EQ(message.header.stamp, kContext.stamp);
  EXPECT_EQ(message.name, (Names{"cart_joint", "hinge"}));
  EXPECT_EQ(message.position, (Numbers{1.0, 5.0}));
  EXPECT_EQ(message.velocity, (Numbers{2.0, 6.0}));
  EXPECT_EQ(message.effort, (Numbers{4.0, 8.0}));
}

TEST(Conversions, FrictionSaysWhetherItIsATorque) {
  const auto message = joint_friction(sample_names(), sample_frame(0.0), kContext);
  EXPECT_EQ(message.header.frame_id, "ground");
  EXPECT_EQ(message.name, (Names{"cart_joint", "hinge"}));
  ASSERT_EQ(message.is_torque.size(), 2U);
  EXPECT_FALSE(message.is_torque[0]);
  EXPECT_TRUE(message.is_torque[1]);
  EXPECT_EQ(message.friction, (Numbers{-0.75, 0.25}));
  EXPECT_EQ(message.normal_force, (Numbers{2.5, 1.5}));
  EXPECT_EQ(message.sliding_velocity, (Numbers{-0.5, 0.125}));
}

TEST(Conversions, ControllersAndLoops) {
  const auto controllers = controller_states(sample_names(), sample_frame(0.0), kContext);
  EXPECT_EQ(controllers.name, Names{"speed"});
  EXPECT_EQ(controllers.setpoint, Numbers{10.0});
  EXPECT_EQ(controllers.input, Numbers{8.0});
  EXPECT_EQ(controllers.error, Numbers{2.0});
  EXPECT_EQ(controllers.integral, Numbers{0.5});
  EXPECT_EQ(controllers.output, Numbers{20.0});
  const auto loops = loop_errors(sample_names(), sample_frame(0.0), kContext);
  EXPECT_EQ(loops.name, Names{"loop_joint"});
  EXPECT_EQ(loops.error, Numbers{1e-9});
}

TEST(Conversions, Signals) {
  const auto message = signals(sample_names(), sample_frame(0.0), kContext);
  EXPECT_EQ(message.name, (Names{"cart_joint/position", "speed/output"}));
  EXPECT_EQ(message.value, (Numbers{1.0, 20.0}));
}

void expect_transform(const geometry_msgs::TransformStamped& transform, const std::string& parent,
                      const std::string& child, const Eigen::Vector3d& position, double yaw) {
  EXPECT_EQ(transform.header.frame_id, parent);
  EXPECT_EQ(transform.child_frame_id, child);
  EXPECT_NEAR(transform.transform.translation.x, position.x(), 1e-15);
  EXPECT_NEAR(transform.transform.translation.y, position.y(), 1e-15);
  EXPECT_NEAR(transform.transform.translation.z, position.z(), 1e-15);
  EXPECT_NEAR(transform.transform.rotation.w, std::cos(yaw / 2), 1e-15);
  EXPECT_NEAR(transform.transform.rotation.z, std::sin(yaw / 2), 1e-15);
}

TEST(Conversions, AFreeLinkIsPlacedRelativeToItsParent) {
  const auto message = free_link_transforms(sample_names(), sample_frame(0.0), kContext);
  ASSERT_EQ(message.transforms.size(), 1U);
  // Two metres along the world's y are two metres along the x of a cart turned by 90 degrees.
  expect_transform(message.transforms[0], "cart", "plate", {2.0, 0.0, 0.0}, kPi / 2);
}

TEST(Conversions, InTheBagOfAJobTheRootOfTheTreeHangsOnTheFrameOfItsSide) {
  const auto message = placed_link_transforms(sample_names(), sample_parents(), sample_frame(0.0),
                                              kContext.stamp, "tuned/");
  ASSERT_EQ(message.transforms.size(), 3U);
  expect_transform(message.transforms[0], "tuned", "tuned/ground", {0.0, 0.0, 0.0}, 0.0);
  expect_transform(message.transforms[1], "tuned/ground", "tuned/cart", {1.0, 0.0, 0.0}, kPi / 2);
  expect_transform(message.transforms[2], "tuned/cart", "tuned/plate", {2.0, 0.0, 0.0}, kPi / 2);
}

TEST(Conversions, WithAPrefixLinksHangOnTheirParents) {
  const auto message =
      link_transforms(sample_names(), {0, 0, 1}, sample_frame(0.0), kContext.stamp, "left/");
  ASSERT_EQ(message.transforms.size(), 2U);
  expect_transform(message.transforms[0], "left/ground", "left/cart", {1.0, 0.0, 0.0}, kPi / 2);
  expect_transform(message.transforms[1], "left/cart", "left/plate", {2.0, 0.0, 0.0}, kPi / 2);
}

TEST(Conversions, TheParentOfALinkIsThatOfItsJointAndOfNoLoop) {
  RobotDescription robot;
  robot.links.resize(3);
  robot.root = 0;
  robot.joints.resize(3);
  const int ends[][2] = {{1, 2}, {0, 1}, {0, 2}};  // parent, child
  for (std::size_t k = 0; k < 3; ++k) {
    robot.joints[k].parent = ends[k][0];
    robot.joints[k].child = ends[k][1];
  }
  robot.joints[2].is_loop = true;
  EXPECT_EQ(link_parents(robot), (std::vector<std::size_t>{0, 0, 1}));
}

}  // namespace
}  // namespace codesign
