// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/posture_sequence.h"

#include <gtest/gtest.h>

#include "integration/turning_loops.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/postures.h"

namespace codesign {
namespace {

struct Recorded {
  Status status;
  std::vector<double> times;
  std::vector<std::vector<double>> signals;
  Warnings warnings;
};

Recorded record(const Problem& problem, const std::vector<std::string>& signals,
                const std::vector<double>& parameters = {}) {
  Simulation simulation(problem, parameters.empty() ? problem.parameters() : parameters, signals);
  Recorded result;
  const int count = static_cast<int>(problem.duration()) + 1;
  result.status = simulate(&simulation, problem.duration(), count, [&](const Frame& frame) {
    result.times.push_back(frame.time);
    result.signals.push_back(frame.signals);
    return true;
  });
  result.warnings = simulation.warnings();
  return result;
}

/// The links a, b, c are 0.55464, 1.44084 and 0.72463 m.
Problem function_generator(const std::string& crank, const std::string& guess) {
  return postures("four_bar_function",
                  "positions: {crank_joint: " + crank +
                      "}\ninitial_state: {rocker_joint: {guess: " + guess +
                      "}, crank_joint: {velocity: 2.0}}\nparameters: {a: {initial: 0.55464}, b: "
                      "{initial: 1.44084}, c: {initial: 0.72463}}\n");
}

TEST(PostureSequence, FollowsTheListWithClosedLoops) {
  const std::vector<double> angles{1.7, 2.0, 2.5, 3.1, 3.7, 2.2};
  const Recorded run = record(function_generator("[1.7, 2.0, 2.5, 3.1, 3.7, 2.2]", "1.0"),
                              {"crank_joint/position", "rocker_joint/position"});
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  ASSERT_EQ(run.signals.size(), angles.size());
  for (std::size_t k = 0; k < angles.size(); ++k) {
    EXPECT_EQ(run.times[k], static_cast<double>(k));
    EXPECT_DOUBLE_EQ(run.signals[k][0], angles[k]);
    EXPECT_NEAR(opening(0.55464, 1.44084, 0.72463, angles[k], run.signals[k][1]), 0.0, 1e-12);
  }
}

// At the second crank angle the rocker's old position is nearer to the other branch, to which
// Newton's method converges at once.
TEST(PostureSequence, KeepsTheBranchBetweenDistantPostures) {
  const auto end = [](const std::string& crank) {
    const Recorded run = record(
        postures("four_bar_function", "positions: {crank_joint: " + crank +
                                          "}\ninitial_state: {rocker_joint: {guess: 1.573}}\n"
                                          "parameters: {a: {initial: 3, tune: false}, b: {initial: "
                                          "1, tune: false}, c: {initial: 3.2, tune: false}}\n"),
        {"rocker_joint/position"});
    EXPECT_TRUE(run.status.ok()) << run.status.cause;
    return run.signals.back()[0];
  };
  const double fine = end("{from: 0.974, to: 1.427, count: 60}");
  EXPECT_NEAR(fine, 2.07828, 1e-4);
  EXPECT_NEAR(end("[0.974, 1.427]"), fine, 1e-10);
}

// The rate of the rocker for the given rate of the crank, by the angles of the velocity triangle.
TEST(PostureSequence, GivenVelocitiesHoldInEachPosture) {
  const Recorded run =
      record(function_generator("[1.7, 2.5, 3.7]", "1.0"),
             {"crank_joint/position", "rocker_joint/position", "rocker_joint/velocity"});
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  for (const std::vector<double>& at : run.signals) {
    const std::complex<double> i(0.0, 1.0), crank = std::polar(0.55464, at[0]),
                                            rocker = std::polar(0.72463, at[1]),
                                            coupler = crank - 1.0 - rocker;
    const double expected =
        2.0 * (std::conj(coupler) * i * crank).real() / (std::conj(coupler) * i * rocker).real();
    EXPECT_NEAR(at[2], expected, 1e-12);
  }
}

// Both branches, and a branch that does not depend on the length of the steps.
TEST(PostureSequence, KeepsTheBranch) {
  const std::vector<std::string> signals{"crank_joint/position", "rocker_joint/position"};
  const auto side = [](const std::vector<double>& at) {
    const std::complex<double> diagonal = std::polar(0.4, at[0]) - 1.0;
    return (std::conj(diagonal) * std::polar(1.0, at[1])).imag();
  };
  // With these lengths of crank and coupler the crank turns fully: here twice.
  const std::vector<double> turning{0.4, 1.2, 0.72463};
  double last = 0.0;
  for (const std::string guess : {"1.0", "-2.0"}) {
    const Recorded fine = record(function_generator("{from: 1.7, to: 14.2, count: 60}", guess),
                                 signals, turning),
                   coarse = record(function_generator("[1.7, 14.2]", guess), signals, turning);
    ASSERT_TRUE(fine.status.ok() && coarse.status.ok()) << fine.status.cause << coarse.status.cause;
    for (const std::vector<double>& at : fine.signals)
      EXPECT_GT(side(at) * side(fine.signals.front()), 0.0);
    EXPECT_NEAR(fine.signals.back()[1], coarse.signals.back()[1], 1e-12);
    EXPECT_NE(last, fine.signals.back()[1]);
    last = fine.signals.back()[1];
  }
}

TEST(PostureSequence, APostureThatCannotBeReachedIsNamed) {
  // With a crank of 1.3 m the linkage opens before the crank lies on the far side.
  const Problem problem = function_generator("[1.0, 1.3, 3.1]", "1.0");
  std::vector<double> longer = problem.parameters();
  longer[0] = 1.3;
  const Recorded run = record(problem, {}, longer);
  EXPECT_EQ(run.status.code, StatusCode::kAssemblyFailed);
  EXPECT_EQ(run.status.time, 2.0);
  EXPECT_NE(run.status.cause.find("posture 2: loop or coupling 'coupler' cannot be closed on the "
                                  "way from posture 1"),
            std::string::npos)
      << run.status.cause;
}

TEST(PostureSequence, StaysAtItsEndAndCanGoOnWithOtherValues) {
  const Problem problem = function_generator("[1.7, 2.0]", "1.0");
  Simulation simulation(problem, problem.parameters(), {"rocker_joint/position"});
  ASSERT_TRUE(simulation.start().ok());
  ASSERT_TRUE(simulation.advance(4.5).ok());
  Frame frame;
  simulation.sample(4.5, &frame);
  EXPECT_NEAR(opening(0.55464, 1.44084, 0.72463, 2.0, frame.signals[0]), 0.0, 1e-13);
  std::vector<double> other = problem.parameters();
  other[1] = 1.3;
  ASSERT_TRUE(simulation.go_on(4.5, other).ok());
  simulation.sample(simulation.time(), &frame);
  EXPECT_NEAR(opening(0.55464, 1.3, 0.72463, 2.0, frame.signals[0]), 0.0, 1e-13);
}

/// Two links of 2 and 1 kg that hang from hinges about y, with their centres 0.3 m below these.
const std::string kHangingLinks = [] {
  const auto link = [](const std::string& name, const std::string& mass) {
    return "<link name='" + name + "'><inertial><origin xyz='0 0 -0.3'/><mass value='" + mass +
           "'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial></link>";
  };
  return "<robot name='links'><link name='base'/>" + link("upper", "2") + link("lower", "1") +
         "<joint name='shoulder' type='continuous'><parent link='base'/><child link='upper'/><axis "
         "xyz='0 1 0'/></joint><joint name='elbow' type='continuous'><parent link='upper'/><child "
         "link='lower'/><origin xyz='0 0 -0.6'/><axis xyz='0 1 0'/></joint></robot>";
}();

Problem hanging_links(const std::string& hold) {
  return load_problem(
      {"links.urdf", kHangingLinks}, {},
      {"links.yaml",
       "positions: {shoulder: [0.2, 0.9, 1.4], elbow: [0.0, -0.5, 1.0]}\nhold: " + hold + "\n"});
}

TEST(PostureSequence, DrivesHoldPosturesWithTheTorqueOfGravity) {
  const double upper[] = {0.2, 0.9, 1.4}, lower[] = {0.0, -0.5, 1.0}, g = 9.81;
  const Recorded run = record(hanging_links("true"), {"shoulder/effort", "elbow/effort",
                                                      "shoulder/position", "elbow/acceleration"});
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  ASSERT_EQ(run.signals.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double elbow = 0.3 * g * std::sin(upper[k] + lower[k]),
                 shoulder = (2.0 * 0.3 + 0.6) * g * std::sin(upper[k]) + elbow;
    EXPECT_NEAR(run.signals[k][0], shoulder, 1e-12);
    EXPECT_NEAR(run.signals[k][1], elbow, 1e-12);
    EXPECT_NEAR(run.signals[k][2], upper[k], 1e-15);
    EXPECT_NEAR(run.signals[k][3], 0.0, 1e-12);
  }
}

// The forearm falls, and its weight counts only as far as its inertia holds against it.
TEST(PostureSequence, JointsThatNoDriveHoldAreLetGo) {
  const Recorded held = record(hanging_links("true"), {"shoulder/effort"}),
                 run = record(hanging_links("[shoulder]"),
                              {"shoulder/effort", "elbow/effort", "elbow/acceleration"});
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_EQ(run.signals[k][1], 0.0);
    const double angle = k == 1 ? 0.4 : 2.4;
    EXPECT_NEAR(run.signals[k][2], -0.3 * 9.81 * std::sin(angle) / (0.1 + 0.09), 1e-10);
    EXPECT_GT(std::abs(run.signals[k][0] - held.signals[k][0]), 0.1);
  }
}

TEST(PostureSequence, LoopsCountTheTurnsBetweenDistantPostures) {
  const std::vector<double> angles{0.3, 5.0, 25.3, 25.0, -9.7};
  for (const char* coordinates : {"joint", "absolute"}) {
    const Problem problem = load_problem(
        {"rotor.urdf", rotor_with_slides()}, {},
        {"rotor.yaml", std::string("gravity: [0, 0, 0]\npositions: {crank: [0.3, 5.0, 25.3, 25.0, "
                                   "-9.7]}\nparameters: {k: {}}\nsolver: {coordinates: ") +
                           coordinates + "}\n"});
    const Recorded run = record(problem, {"pin/position"});
    ASSERT_TRUE(run.status.ok()) << run.status.cause;
    ASSERT_EQ(run.signals.size(), angles.size());
    for (std::size_t k = 0; k < angles.size(); ++k)
      EXPECT_NEAR(run.signals[k][0], angles[k], 1e-12) << coordinates << ", posture " << k;
  }
}

TEST(PostureSequence, RefusesToHoldWhatHasNoPostures) {
  for (const char* hold : {"[wrist]", "7"}) EXPECT_THROW(hanging_links(hold), InputError) << hold;
  EXPECT_THROW(
      load_problem({"links.urdf", kHangingLinks}, {}, {"links.yaml", "duration: 1\nhold: true\n"}),
      InputError);
}

/// A parallelogram of cranks of 0.1 m, 0.3 m apart along x: flat where they lie along x.
std::string change_point(const std::string& out_of_plane) {
  const auto link = [](const std::string& name, const std::string& at) {
    return "<link name='" + name + "'><inertial><origin xyz='" + at +
           "'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.001' iyz='0' "
           "izz='0.001'/></inertial></link>";
  };
  const auto pin = [](const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& at) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + at + "'/><axis xyz='0 1 0'/></joint>";
  };
  return "<robot name='r' xmlns:codesign='urn:mechanism_codesign'><link name='g'/>" +
         link("cr", "0 0 0.05") + link("co", "0.1 0 0") + link("fo", "0 0 0.05") +
         pin("crank", "g", "cr", "0 0 0") + pin("knee", "cr", "co", "0 0 0.1") +
         pin("foll", "g", "fo", "0.3 0 0") + "<loop name='pin' type='revolute'" + out_of_plane +
         "><predecessor link='co'><origin xyz='0.3 0 0'/></predecessor><successor "
         "link='fo'><origin xyz='0 0 0.1'/></successor><axis xyz='0 1 0'/></loop></robot>";
}

Problem change_points(const std::string& angles, const std::string& out_of_plane) {
  return load_problem({"change_point.urdf", change_point(out_of_plane)}, {},
                      {"postures.yaml", "positions: {crank: " + angles +
                                            "}\ninitial_state: {foll: {guess: 0.3}}\n"});
}

// The follower turns with the crank on both sides of the flat postures, which are between two of
// the list.
TEST(PostureSequence, AParallelogramGoesOnBeyondItsFlatPosture) {
  for (const char* out_of_plane : {" codesign:out_of_plane='zero'", ""})
    for (const char* angles : {"{from: 0.3, to: 6.5, count: 25}", "{from: 0.3, to: 6.5, count: 7}",
                               "[1.5, 1.6, 1.5, 1.6]"}) {
      const Recorded run =
          record(change_points(angles, out_of_plane), {"crank/position", "foll/position"});
      ASSERT_TRUE(run.status.ok()) << angles << out_of_plane << ": " << run.status.cause;
      for (const std::vector<double>& at : run.signals)
        EXPECT_NEAR(at[0], at[1], 1e-4) << angles << out_of_plane;
    }
}

TEST(PostureSequence, ASingularPostureIsNamed) {
  const auto named = [](const std::string& angles) {
    const Recorded run = record(change_points(angles, " codesign:out_of_plane='zero'"),
                                {"crank/position", "foll/position"});
    EXPECT_TRUE(run.status.ok()) << run.status.cause;
    std::string text;
    for (const Warning& warning : run.warnings)
      if (warning.code == "singular_posture") text += warning.message;
    return text;
  };
  const std::string flat = named("[0.3, 1.5707963267948966, 2.0]");
  EXPECT_NE(flat.find("posture 1 (crank = 1.570796327)"), std::string::npos) << flat;
  EXPECT_EQ(named("[0.3, 1.5, 1.7]"), "") << "beside it";
}

}  // namespace
}  // namespace codesign
