// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "description/study.h"
#include "reading/study/study_reader.h"

namespace codesign {

/// A crank on a revolute joint, a slider on a prismatic one with friction, a ball on a planar one;
/// two parameters.
inline RobotDescription study_robot() {
  RobotDescription robot;
  robot.name = "robot";
  robot.parameters = {{"crank_length", 0.08, 0.06, 0.1, "m", {"robot.urdf", 3}},
                      {"rod_length", 0.3, 0.2, 0.4, "m", {"robot.urdf", 4}}};
  for (const char* name : {"ground", "crank", "slider", "ball"})
    robot.links.push_back({name, std::nullopt, {}});
  const auto add = [&robot](const char* name, JointType type) {
    JointDescription joint;
    joint.name = name;
    joint.type = type;
    robot.joints.push_back(joint);
  };
  add("crank_joint", JointType::kRevolute);
  add("slider_joint", JointType::kPrismatic);
  add("ball_joint", JointType::kPlanar);
  robot.joints[1].friction.emplace();
  robot.joints[1].friction->mu_static = Quantity(0.3);
  robot.joints[1].friction->mu_dynamic = Quantity(0.2);
  return robot;
}

/// A minimal study, to which tests add lines.
inline const std::string kLeastStudy =
    "duration: 2.0\nobjective: {integral: [{signal: crank_joint/velocity}]}\n";

inline Study read_text(const std::string& text) {
  return read_study({"study.yaml", text}, study_robot());
}

/// The fault of an invalid study; the test fails if reading it succeeds.
inline InputFault fault_in(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "study.yaml");
    return error.fault();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return {};
}

/// Expects an error at `element` and `line` whose message contains `message`.
inline void expect_fault(const std::string& text, const std::string& element,
                         const std::string& message, int line) {
  const InputFault fault = fault_in(text);
  EXPECT_EQ(fault.element, element) << text;
  EXPECT_NE(fault.message.find(message), std::string::npos) << fault.message << "\n" << text;
  EXPECT_EQ(fault.where.line, line) << text;
}

}  // namespace codesign
