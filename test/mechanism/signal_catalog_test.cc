// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/signal_catalog.h"
#include "description/study.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

LinkDescription link(const std::string& name, bool massive) {
  LinkDescription description;
  description.name = name;
  if (massive) description.inertial.emplace().mass = 1.0;
  return description;
}

JointDescription joint(const std::string& name, JointType type, int child) {
  JointDescription description;
  description.name = name;
  description.type = type;
  description.parent = child - 1;
  description.child = child;
  return description;
}

/// A chain from the ground; its last joint moves only a massless pointer. One link has the same
/// name as a joint.
RobotDescription catalog_robot() {
  RobotDescription robot;
  robot.links = {link("ground", false), link("arm", true),        link("hinge", true),
                 link("plate", true),   link("plate_end", false), link("pointer", false)};
  robot.joints = {joint("hinge", JointType::kRevolute, 1), joint("slide", JointType::kPrismatic, 2),
                  joint("plane", JointType::kPlanar, 3), joint("weld", JointType::kFixed, 4),
                  joint("needle", JointType::kRevolute, 5)};
  robot.joints[1].friction.emplace();
  robot.joints[1].friction->joint_length = Quantity(0.1);
  robot.joints[1].friction->joint_width = Quantity(0.05);
  robot.joints[2].dry_friction = robot.joints[4].dry_friction = 0.1;
  return robot;
}

std::vector<ControllerDescription> controllers() {
  ControllerDescription controller;
  controller.name = "speed";
  return {controller};
}

void check(const std::string& text) {
  check_signal(parse_signal(text, {"s.yaml", 2}, "here"), catalog_robot(), controllers(), "here");
}

void expect_refused(const std::string& text, const std::string& message,
                    const std::string& allowed) {
  try {
    check(text);
    ADD_FAILURE() << text;
  } catch (const InputError& error) {
    EXPECT_NE(error.fault().message.find(message), std::string::npos) << error.what();
    EXPECT_NE(error.fault().allowed.find(allowed), std::string::npos) << error.what();
    EXPECT_EQ(error.fault().where.line, 2);
    EXPECT_EQ(error.fault().element, "here");
  }
}

TEST(SignalCatalog, AcceptsWhatEachKindOffers) {
  for (const char* quantity : {"position", "velocity", "acceleration", "effort"})
    check(std::string("hinge/") + quantity);
  for (const char* quantity : {"friction", "normal_force", "sliding_velocity"}) {
    check(std::string("slide/") + quantity);
    check(std::string("plane/") + quantity);
  }
  for (const char* quantity : {"position", "velocity", "angular_velocity"})
    for (const char* component : {"/x", "/y", "/z"})
      check(std::string("arm/") + quantity + component);
  for (const char* quantity : {"error", "integral", "output"})
    check(std::string("speed/") + quantity);
  check("hinge/velocity - slide/velocity + arm/position/z");
}

TEST(SignalCatalog, PowersEnergiesAndOrientations) {
  for (const char* quantity : {"actuator_power", "damping_power", "load_power"})
    check(std::string("hinge/") + quantity);
  for (const char* joint : {"slide", "plane"}) check(std::string(joint) + "/friction_power");
  for (const char* quantity : {"kinetic_energy", "potential_energy", "total_energy",
                               "friction_power", "damping_power", "actuator_power", "load_power"})
    check(std::string("mechanism/") + quantity);
  for (const char* component : {"w", "x", "y", "z"})
    check(std::string("arm/orientation/") + component);
  expect_refused("hinge/friction_power", "unknown quantity", "hinge/actuator_power");
  expect_refused("mechanism/energy", "unknown quantity", "mechanism/total_energy");
  expect_refused("mechansim/total_energy", "did you mean \"mechanism\"", "");
  expect_refused("mechanism/total_energy/x", "no components", "");
  expect_refused("arm/orientation", "needs the component w, x, y or z",
                 "arm/orientation/{w,x,y,z}");
}

TEST(SignalCatalog, ReactionsOfJointsThatMove) {
  for (const char* joint : {"hinge", "slide", "plane", "needle"})
    for (const char* quantity : {"/reaction_force/x", "/reaction_torque/z"})
      check(std::string(joint) + quantity);
  expect_refused("hinge/reaction_force", "needs the component x, y or z",
                 "hinge/reaction_force/{x,y,z}");
  expect_refused("hinge/reaction_force/w", "needs the component x, y or z",
                 "hinge/reaction_force/{x,y,z}");
  expect_refused("weld/reaction_torque/x", "form one body", "loop type=\"fixed\"");
  expect_refused("arm/reaction_force/x", "unknown quantity", "arm/position/{x,y,z}");
}

TEST(SignalCatalog, WhatIsCalledLikeTheMechanismKeepsItsSignals) {
  const auto check_in = [](const RobotDescription& robot, const std::string& text) {
    check_signal(parse_signal(text, {"s.yaml", 2}, "here"), robot, controllers(), "here");
  };
  RobotDescription named = catalog_robot();
  named.links[1].name = "mechanism";
  for (const char* text :
       {"mechanism/position/x", "mechanism/total_energy", "mechanism/friction_power"})
    check_in(named, text);
  named.joints[1].name = "mechanism";
  for (const char* text : {"mechanism/position", "mechanism/position/x", "mechanism/total_energy"})
    check_in(named, text);
  try {
    check_in(named, "mechanism/friction_power");
    ADD_FAILURE() << "of the joint or of all?";
  } catch (const InputError& error) {
    EXPECT_NE(error.fault().message.find("the power of the whole mechanism"), std::string::npos)
        << error.what();
  }
}

TEST(SignalCatalog, ALinkMayBearTheNameOfAJoint) {
  check("hinge/position");
  check("hinge/position/x");
}

TEST(SignalCatalog, RefusesUnknownNames) {
  expect_refused("hing/velocity", "did you mean \"hinge\"", "hinge, slide");
  expect_refused("hinge/velocity - sped/output", "did you mean \"speed\"", "speed");
}

TEST(SignalCatalog, RefusesQuantitiesOfAnotherKind) {
  expect_refused("slide/velocty", "did you mean \"velocity\"", "slide/velocity");
  expect_refused("hinge/friction", "unknown quantity", "hinge/effort");
  expect_refused("weld/position", "unknown quantity", "");
  expect_refused("plane/velocity", "unknown quantity", "plane/normal_force");
  expect_refused("speed/velocity", "unknown quantity", "speed/output");
  expect_refused("arm/effort/x", "unknown quantity", "arm/position/{x,y,z}");
}

TEST(SignalCatalog, ComponentsBelongToLinks) {
  expect_refused("arm/position", "needs the component", "arm/position/{x,y,z}");
  expect_refused("arm/position/w", "needs the component", "arm/position/{x,y,z}");
  expect_refused("slide/velocity/x", "no components", "slide/velocity");
}

TEST(SignalCatalog, AStudyReadsEachSignalOnce) {
  const auto signal = [](const std::string& text) { return parse_signal(text, {}, "here"); };
  Study study;
  study.integral.resize(2);
  study.terminal.resize(1);
  study.integral[0].signal = signal("hinge/velocity");
  study.integral[1].signal = signal("arm/position/x");
  study.terminal[0].signal = signal("hinge/velocity");
  study.controllers = controllers();
  study.controllers[0].input = signal("slide/position");
  study.controllers.emplace_back();
  study.controllers[1].feedback.resize(1);
  study.controllers[1].feedback[0].signal = signal("hinge/reaction_force/x");
  std::vector<std::string> texts;
  for (const SignalDescription& read : signals_of(study)) texts.push_back(read.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"hinge/velocity", "arm/position/x", "slide/position",
                                             "hinge/reaction_force/x"}));
}

TEST(SignalCatalog, DefaultsCoverJointsFrictionAndControllers) {
  const std::vector<std::string> expected = {
      "hinge/position",         "hinge/velocity", "slide/position",
      "slide/velocity",         "slide/friction", "slide/normal_force",
      "slide/sliding_velocity", "plane/friction", "plane/normal_force",
      "plane/sliding_velocity", "speed/output"};
  EXPECT_EQ(default_signals(catalog_robot(), controllers()), expected);
  for (const std::string& signal : expected) check(signal);
}

TEST(SignalCatalog, AJointWithClearanceHasTheForceOfItsContact) {
  RobotDescription robot = catalog_robot();
  robot.links[1].name = robot.joints[0].name = "slide_x";
  robot.joints[0].is_play = true;
  const auto fault = [&robot](const std::string& text) {
    try {
      check_signal(parse_signal(text, {"s.yaml", 2}, "here"), robot, controllers(), "here");
    } catch (const InputError& error) {
      EXPECT_NE(error.fault().message.find("carried by its contact"), std::string::npos) << text;
      return error.fault().allowed;
    }
    return std::string();
  };
  for (const char* joint : {"slide", "slide_x"})
    for (const char* quantity : {"/reaction_force/x", "/reaction_torque/z"})
      EXPECT_EQ(fault(std::string(joint) + quantity), "slide_clearance/normal_force");
  EXPECT_EQ(fault("slide/position"), "");
  EXPECT_EQ(fault("plane/reaction_force/x"), "") << "of the next joint";
}

}  // namespace
}  // namespace codesign
