// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/starting_overlay.h"

#include <filesystem>

#include "found_robots.h"
#include "mechanism/mass_properties.h"
#include "paths.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// The overlay with the marks of its comments taken away from all lines to fill in.
std::string filled_in(std::string text) {
  const std::string mark = "<!-- <", end = " -->";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
    text.erase(at, mark.size() - 1);
    text.erase(text.find(end, at), end.size());
  }
  return text;
}

bool has_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

SourceText robot_of_vendor(const std::string& body) {
  return {"vendor.urdf", "<robot name=\"vendor\">\n" + body + "\n</robot>"};
}

const char kVendorJoint[] =
    "<axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\" effort=\"40\" velocity=\"4\"/>";

SourceText vendor_arm(const std::string& joint_content) {
  return robot_of_vendor(
      kGround + link_with("arm") +
      joint_with("hinge", "revolute", "ground", "arm", kVendorJoint + joint_content));
}

TEST(StartingOverlay, AnArmatureIsTheRotorThatTheJointFeels) {
  const SourceText urdf = vendor_arm("<dynamics damping=\"0.1\" armature=\"0.18\"/>");
  const std::string text = starting_overlay(urdf);
  const RobotDescription robot = read_urdf(urdf, {{"notes.urdf", text}});
  ASSERT_TRUE(robot.joints[0].actuator.has_value()) << text;
  const double n = robot.joints[0].actuator->gear_ratio.nominal();
  EXPECT_NEAR(n * n * robot.joints[0].actuator->rotor_inertia.nominal(), 0.18, 1e-15);
  EXPECT_TRUE(robot.warnings.empty())
      << "that of armature ends with the actuator: " << robot.warnings.front().message;
  EXPECT_FALSE(has_text(text, "Friction of hinge")) << "the file has a damping";
}

TEST(StartingOverlay, AGearRatioComesFromTheTransmission) {
  const SourceText urdf = robot_of_vendor(
      kGround + link_with("arm") +
      joint_with("hinge", "revolute", "ground", "arm",
                 std::string(kVendorJoint) + "<dynamics damping=\"0.1\" armature=\"0.18\"/>") +
      "<transmission name=\"t\"><type>transmission_interface/SimpleTransmission</type><joint "
      "name=\"hinge\"/><actuator name=\"m\"><mechanicalReduction>50</mechanicalReduction>"
      "</actuator></transmission>");
  const RobotDescription robot = read_urdf(urdf, {{"notes.urdf", starting_overlay(urdf)}});
  EXPECT_EQ(robot.joints[0].actuator->gear_ratio.nominal(), 50.0);
  EXPECT_EQ(robot.joints[0].actuator->rotor_inertia.nominal(), 0.18 / 2500.0);
}

TEST(StartingOverlay, GearsAndFrictionAreLinesToFillIn) {
  const SourceText urdf = vendor_arm("");
  const std::string text = starting_overlay(urdf);
  const RobotDescription as_written = read_urdf(urdf, {{"notes.urdf", text}});
  EXPECT_FALSE(as_written.joints[0].actuator.has_value());
  EXPECT_TRUE(as_written.joints[0].damping.is_zero());
  EXPECT_TRUE(has_text(text, "<!-- Friction of hinge. Usual: 3 % of its limit, 40 N m")) << text;
  const RobotDescription robot = read_urdf(urdf, {{"notes.urdf", filled_in(text)}});
  EXPECT_DOUBLE_EQ(robot.joints[0].dry_friction.nominal(), 1.2);
  EXPECT_DOUBLE_EQ(robot.joints[0].damping.nominal(), 0.3);
  EXPECT_DOUBLE_EQ(robot.joints[0].actuator->gear_ratio.nominal(), 100.0);
  EXPECT_NEAR(robot.joints[0].actuator->rotor_inertia.nominal() * 1e4, 0.04, 1e-12);
}

TEST(StartingOverlay, WhatAnOverlayGivesIsNotAskedForAgain) {
  const std::string text = starting_overlay(
      vendor_arm(""), {overlay_text("<joint name=\"hinge\"><dynamics friction=\"1\"/>"
                                    "<codesign:actuator rotor_inertia=\"1\"/></joint>")});
  EXPECT_FALSE(has_text(text, "hinge")) << text;
}

TEST(StartingOverlay, ABaseThatCouldBeFreeIsALineAndOneThatMustBeIsAnElement) {
  const std::string free = "type=\"floating\"";
  const SourceText walker =
      robot_of_vendor(link_with("trunk") + link_with("leg") +
                      joint_with("hip", "continuous", "trunk", "leg", "<axis xyz=\"0 1 0\"/>"));
  const std::string text = starting_overlay(walker);
  EXPECT_TRUE(has_text(text, "Base: the root link trunk is the ground, and the 2 kg")) << text;
  EXPECT_EQ(read_urdf(walker, {{"notes.urdf", text}}).joints.size(), 1U);
  EXPECT_EQ(read_urdf(walker, {{"notes.urdf", filled_in(text)}}).joints.size(), 2U);
  const SourceText drone =
      robot_of_vendor(link_with("world") + link_with("rotor", "") +
                      joint_with("spin", "continuous", "world", "rotor", "<axis xyz=\"0 0 1\"/>"));
  const RobotDescription robot = read_urdf(drone, {{"notes.urdf", starting_overlay(drone)}});
  ASSERT_EQ(robot.joints.size(), 2U);
  EXPECT_EQ(robot.joints[1].type, JointType::kFloating);
  EXPECT_EQ(robot.links[static_cast<std::size_t>(robot.root)].name, "world_2");
  EXPECT_FALSE(has_text(starting_overlay(vendor_arm("")), free)) << "its root has no mass";
}

TEST(StartingOverlay, MassesComeFromShapesOrAreToBeFilledIn) {
  const std::string zero =
      "<inertial><origin xyz=\"1 2 3\" rpy=\"1 0 0\"/><mass value=\"0\"/><inertia ixx=\"0\" "
      "ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>";
  const SourceText urdf = robot_of_vendor(
      kGround +
      link_with("box", zero + "<visual><origin xyz=\"0 0 0.1\"/><geometry><box size=\"0.1 0.1 "
                              "0.2\"/></geometry></visual>") +
      link_with("shell",
                "<visual><geometry><mesh filename=\"package://x/a--b.stl\"/></geometry></visual>") +
      joint_with("j--1", "continuous", "ground", "box", "<axis xyz=\"0 1 0\"/>") +
      joint_with("j2", "continuous", "box", "shell", "<axis xyz=\"0 1 0\"/>"));
  const std::string text = starting_overlay(urdf);
  EXPECT_TRUE(has_text(text, "which has none but the mesh package://x/a- -b.stl")) << text;
  const RobotDescription robot = read_urdf(urdf, {{"notes.urdf", filled_in(text)}});
  const MassProperties<double> box =
      mass_properties(*robot.links[1].inertial, std::vector<double>{});
  EXPECT_NEAR(box.mass, 2.0, 1e-12) << "2 l of water";
  EXPECT_NEAR(box.centre[2], 0.1, 1e-12);
  EXPECT_EQ(robot.links[2].inertial->mass.nominal(), 1.0);
  EXPECT_TRUE(robot.joints[0].actuator.has_value()) << "j--1";
}

TEST(StartingOverlay, ACompoundJointHasNoDriveBetweenItsLinks) {
  const std::string text = starting_overlay(
      robot_of_vendor(kGround + link_with("cross", "") + link_with("arm") +
                      joint_with("x", "continuous", "ground", "cross", "<axis xyz=\"1 0 0\"/>") +
                      joint_with("y", "continuous", "cross", "arm", "<axis xyz=\"0 1 0\"/>")));
  EXPECT_FALSE(has_text(text, "codesign:actuator")) << text;
  EXPECT_TRUE(has_text(text, "Friction of y")) << text;
}

TEST(StartingOverlay, AFileThatCannotBeReadIsRefused) {
  EXPECT_THROW(starting_overlay(robot_of_vendor("<link/>")), InputError);
}

/// As it is written, and with all lines.
void expect_it_is_read(const std::filesystem::path& path) {
  const SourceText urdf = read_source(path.string());
  const std::string text = starting_overlay(urdf);
  for (const std::string& overlay : {text, filled_in(text)}) {
    try {
      read_urdf(urdf, {{"notes.urdf", overlay}});
    } catch (const InputError& error) {
      ADD_FAILURE() << path << ": " << error.what() << "\n" << overlay;
    }
  }
}

int expect_all_are_read(const std::filesystem::path& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".urdf" || has_text(name, "overlay") ||
        has_text(entry.path().string(), "/overlays/"))
      continue;
    expect_it_is_read(entry.path());
    ++count;
  }
  return count;
}

TEST(StartingOverlay, OfShippedModelsIsRead) {
  EXPECT_GT(expect_all_are_read(std::filesystem::path(source_dir()) / "urdf"), 10);
  EXPECT_GT(expect_all_are_read(std::filesystem::path(source_dir()) / "gallery"), 10);
}

TEST(StartingOverlay, OfRobotsAsTheyAreFoundIsRead) {
  if (found_robots().empty()) GTEST_SKIP() << kNoFoundRobots;
  for (const std::filesystem::path& file : found_robots()) expect_it_is_read(file);
}

TEST(StartingOverlay, AJointBelowOneWithClearanceHasADrive) {
  const std::string text = starting_overlay(
      robot_text(kGround + link_with("block") + link_with("arm") +
                 joint_with("slide", "prismatic", "ground", "block",
                            std::string(kVendorJoint) +
                                "<codesign:clearance radial=\"1e-4\" length=\"0.1\" width=\"0.04\" "
                                "stiffness=\"1e8\"/>") +
                 joint_with("hinge", "revolute", "block", "arm", kVendorJoint)));
  EXPECT_TRUE(has_text(text, "joint name=\"hinge\"")) << text;
  EXPECT_FALSE(has_text(text, "joint name=\"slide\"")) << text;
}

}  // namespace
}  // namespace codesign
