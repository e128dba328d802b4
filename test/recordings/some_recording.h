// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "description/robot.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A hinge that can turn from -1 to 1, a wheel that turns freely, and a slider.
inline RobotDescription recorded_robot() {
  RobotDescription robot;
  const auto add = [&robot](const char* name, JointType type) {
    JointDescription joint;
    joint.name = name;
    joint.type = type;
    robot.joints.push_back(joint);
  };
  add("hinge", JointType::kRevolute);
  add("wheel", JointType::kContinuous);
  add("slider", JointType::kPrismatic);
  add("ball", JointType::kSpherical);
  robot.joints[0].limit.emplace();
  robot.joints[0].limit->lower = Quantity(-1.0);
  robot.joints[0].limit->upper = Quantity(1.0);
  return robot;
}

/// The hinge swings with amplitude 0.5 and 2 rad/s, `count` samples at 100 Hz, all quantities
/// measured.
inline JointRecording swing(std::size_t count) {
  JointRecording recording;
  recording.file = "swing.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 4};
  recording.joints = {{"hinge", {}, {}, {}}};
  JointSamples& samples = recording.joints.front();
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 0.01 * static_cast<double>(k);
    recording.times.push_back(t);
    recording.places.push_back(k + 2);
    samples.position.push_back(0.5 * std::sin(2.0 * t));
    samples.velocity.push_back(std::cos(2.0 * t));
    samples.effort.push_back(3.0 * std::sin(2.0 * t));
  }
  return recording;
}

/// The fault of a call that must be refused.
template <class Call>
InputFault refusal_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

inline void expect_word(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << "no \"" << words << "\" in: " << text;
}

}  // namespace codesign
