// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_output.h"

#include <gtest/gtest.h>

#include <set>

#include "description/study.h"
#include "integration/interactive_simulation.h"
#include "mechanism/signal_catalog.h"
#include "problem/load_problem.h"
#include "reading/urdf/pictures.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/pendulum.h"
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
            (std::vector<std::string>{"a_1/position", "a_1/velocity", "a_1/effort",
                                      "a_1/position_2", "a_1/velocity_2", "a_1/effort_2",
                                      "loop/friction", "loop/normal_force", "loop/sliding_velocity",
                                      "c/setpoint", "c/input", "c/error", "c/integral", "c/output",
                                      "a_1/velocity___loop/reaction"}));
}

TEST(FloatTopics, TheNumbersAreThoseOfTheFrame) {
  const Problem problem = servo_arm();
  InteractiveSimulation run(*system_of(problem), {}, signals_of(study_of(problem)));
  ASSERT_TRUE(run.start(run.parameters()).ok());
  Frame frame;
  ASSERT_TRUE(run.advance(0.1).ok());
  run.sample(0.1, &frame);
  const FrameNumbers numbers(run.names());
  const auto value = [&](const std::string& topic) {
    for (std::size_t k = 0; k < numbers.topics.size(); ++k)
      if (numbers.topics[k] == topic) return numbers.read[k](frame);
    ADD_FAILURE() << topic;
    return 0.0;
  };
  EXPECT_EQ(value("elbow/velocity"), frame.joints[1].velocity);
  EXPECT_EQ(value("hold/error"), frame.controllers[0].error);
  EXPECT_EQ(value("elbow/velocity___shoulder/velocity"),
            frame.joints[1].velocity - frame.joints[0].velocity);
}

const std::function<bool()> kNever = [] { return false; };
const MarkerStyle kNothingGiven{0.0, 0.0, 0.0};

std::string sticks_of(const Problem& problem) {
  return with_sticks(write_tuned_urdf(problem.urdf(), problem.overlays(), problem.parameters()));
}

TEST(SimulationScene, SeesWhereTheRunGoes) {
  const Problem problem = pendulum();
  const SimulationScene scene(problem, sticks_of(problem), kNothingGiven, kNever);
  const mechanism_codesign::Scene message = scene.message({ros::Time(1.0), "left/ground"});
  EXPECT_EQ(message.header.frame_id, "left/ground");
  const double length = problem.parameters()[0];
  // It is let go at 0.5 rad: the bob starts at (-0.48, -0.88) or (0.48, -0.88) of its length.
  EXPECT_LT(message.smallest[2], -0.87 * length);
  EXPECT_GT(message.largest[0] - message.smallest[0], 0.47 * length);
  EXPECT_LT(message.distance, 10.0 * length);
  EXPECT_GT(message.distance, length);
}

TEST(SimulationScene, ScalesThatAreGivenStay) {
  const Problem problem = pendulum();
  const SimulationScene scene(problem, sticks_of(problem), {0.5, 0.0, 0.125}, kNever);
  EXPECT_EQ(scene.style().metres_per_newton, 0.5);
  EXPECT_EQ(scene.style().shaft_diameter, 0.125);
  EXPECT_GT(scene.style().metres_per_newton_metre, 0.0);
  EXPECT_NE(scene.style().solids, nullptr);
}

TEST(SimulationScene, OfARunThatIsStoppedItShowsTheBeginning) {
  const Problem problem = pendulum();
  const SimulationScene scene(problem, sticks_of(problem), kNothingGiven, [] { return true; });
  EXPECT_GT(scene.message({}).distance, 0.0);
}

TEST(SimulationScene, TheTextTellsTimeAndObjective) {
  const Problem problem = pendulum();
  const SimulationScene scene(problem, sticks_of(problem), kNothingGiven, kNever);
  Frame frame;
  frame.time = 0.25;
  frame.objective = 3.0;
  EXPECT_EQ(scene.text(frame, {ros::Time(1.25), "ground"}).markers.at(0).text,
            "t = 0.25 s, objective so far 3");
}

}  // namespace
}  // namespace codesign
