// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/float_topics.h"

#include <gtest/gtest.h>

#include <set>

#include "integration/interactive_simulation.h"
#include "mechanism/signal_catalog.h"
#include "ros/servo_arm.h"

namespace codesign {
namespace {

TEST(FloatTopics, EachNumberHasALegalNameOfItsOwn) {
  FrameNames names;
  names.joints = {"a-1", "a 1", "loop"};
  names.tree_joints = 2;
  names.frictions = {"loop"};
  names.controllers = {"c"};
  names.signals = {"c/output", "a-1/velocity - loop/reaction"};
  const FrameNumbers numbers(names);
  EXPECT_EQ(numbers.topics,
            (std::vector<std::string>{"a_1/position", "a_1/velocity", "a_1/effort", "a_1/position_2", "a_1/velocity_2", "a_1/effort_2",
                                      "loop/friction", "loop/normal_force", "loop/sliding_velocity", "c/setpoint", "c/input", "c/error",
                                      "c/integral", "c/output", "a_1/velocity___loop/reaction"}));
}

TEST(FloatTopics, TheNumbersAreThoseOfTheFrame) {
  const Problem problem = servo_arm();
  InteractiveSimulation run(*problem.system(), {}, signals_of(problem.study()));
  ASSERT_TRUE(run.start(run.parameters()).ok());
  Frame frame;
  ASSERT_TRUE(run.advance(0.1).ok());
  run.sample(0.1, &frame);
  const FrameNumbers numbers(run.names());
  const auto value = [&](const std::string& topic) {
    for (std::size_t k = 0; k < numbers.topics.size(); ++k)
      if (numbers.topics[k] == topic) return numbers.value(frame, k);
    ADD_FAILURE() << topic;
    return 0.0;
  };
  EXPECT_EQ(value("elbow/velocity"), frame.joints[1].velocity);
  EXPECT_EQ(value("hold/error"), frame.controllers[0].error);
  EXPECT_EQ(value("elbow/velocity___shoulder/velocity"), frame.joints[1].velocity - frame.joints[0].velocity);
}

}  // namespace
}  // namespace codesign
