// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch each other: motions against closed forms, the energy balance, signals, events.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/energy_balance.h"
#include "integration/signals_at.h"
#include "integration/touching.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kGravity = 9.81, kRadius = 0.05, kInertia = 0.001;

Problem problem_of(const std::string& urdf, const std::string& study) {
  return load_problem({"ball.urdf", urdf}, {}, {"ball.yaml", study}, {}, TrajectoryLoader(),
                      FileLoader());
}

std::string study(double duration, const std::string& start) {
  return "duration: " + std::to_string(duration) + "\ninitial_state: {free: {" + start +
         "}}\nsolver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-12}\n";
}

TEST(Contact, LeavesWithTheSpeedOfItsRestitution) {
  const double speed = 1.3;
  for (const double e : {0.9, 0.5}) {
    const Problem problem =
        problem_of(free_ball("", touching_ground("shape='plane'",
                                                 "model='gonthier' impact_velocity='1.3' "
                                                 "restitution='" +
                                                     std::to_string(e) + "'")),
                   "gravity: [0, 0, 0]\n" +
                       study(0.1, "translation: [0, 0, 0.06], linear_velocity: [0, 0, -1.3]"));
    const std::vector<double> end =
        signals_at(problem, 0.1, {"ball/velocity/z", "touch/gap", "touch/gap_rate"});
    EXPECT_NEAR(end[0], e * speed, 1e-8) << e;
    EXPECT_GT(end[1], 0.0);
    EXPECT_NEAR(end[2], end[0], 1e-14);
  }
}

// Friction acts at the arm rho, the radius less half of the penetration: m v + I omega/rho is kept,
// and in the end v = rho omega. Without penetration a solid ball keeps 5/7 of its speed.
TEST(Contact, AThrownBallComesToRoll) {
  const double depth = std::pow(kGravity / 1e6, 2.0 / 3.0), arm = kRadius - 0.5 * depth,
               speed = 1.0;
  const std::string friction =
      "<codesign:friction mu_static='0.3' mu_dynamic='0.3' transition_velocity='0.001'/>";
  for (const char* coordinates : {"joint", "absolute"}) {
    const Problem problem =
        problem_of(free_ball("", touching_ground("shape='plane'", "", friction)),
                   "duration: 0.3\ninitial_state: {free: {translation: [0, 0, " +
                       std::to_string(kRadius - depth) +
                       "], linear_velocity: [1, 0, 0]}}\nsolver: {relative_tolerance: 1.0e-9, "
                       "absolute_tolerance: 1.0e-11, coordinates: " +
                       coordinates + "}\n");
    const std::vector<double> sliding =
        signals_at(problem, 0.05, {"ball/velocity/x", "touch/sliding_speed", "touch/friction"});
    EXPECT_NEAR(sliding[0], speed - 0.3 * kGravity * 0.05, 1e-3);
    EXPECT_NEAR(sliding[2], 0.3 * kGravity, 0.02);
    EXPECT_GT(sliding[1], 0.2);
    const std::vector<double> rolling = signals_at(problem, 0.3,
                                                   {"ball/velocity/x", "ball/angular_velocity/y",
                                                    "touch/sliding_speed", "touch/normal_force"});
    const double kept = speed / (1.0 + kInertia / (arm * arm));
    EXPECT_NEAR(rolling[0], kept, 2e-5) << coordinates;
    EXPECT_NEAR(rolling[1], kept / arm, 2e-3) << coordinates;
    EXPECT_LT(rolling[2], 1e-5) << coordinates;
    EXPECT_NEAR(rolling[3], kGravity, 0.05) << coordinates;
  }
}

TEST(Contact, TakesExactlyItsWork) {
  struct Case {
    const char *on, *more, *start;
  };
  for (const Case& of :
       {Case{"shape='plane'", "dissipation='0.3'",
             "translation: [0, 0, 0.3], linear_velocity: [1, 0.3, 0], angular_velocity: [9, 3, 5]"},
        Case{"shape='socket' radius='0.2'", "dissipation='0.3'",
             "translation: [0.1, 0.05, 0], linear_velocity: [1, 0.3, 0]"},
        Case{"shape='bore' radius='0.2'", "model='flores' restitution='0.6' impact_velocity='1'",
             "translation: [0.1, 0.05, 0], linear_velocity: [1, 0.3, 0]"},
        Case{"shape='box' size='0.4 0.4 0.1'", "dissipation='0.3'",
             "translation: [0.21, 0.22, 0.3]"},
        Case{"shape='cylinder' radius='0.2' length='0.1'", "dissipation='0.3'",
             "translation: [0.21, 0.08, 0.3]"},
        Case{"shape='capsule' radius='0.1' length='0.1'", "dissipation='0.3'",
             "translation: [0.03, 0.02, 0.4]"}}) {
    const Balance b = balance(
        free_ball("", touching_ground(of.on, of.more,
                                      "<codesign:friction mu_static='0.2' mu_dynamic='0.15' "
                                      "transition_velocity='0.05'/>")),
        "duration: 0.5\ninitial_state: {free: {" + std::string(of.start) +
            "}}\nobjective: {integral: [{signal: ball/velocity/z}]}\nsolver: " + kFriction + "\n");
    ASSERT_TRUE(b.status.ok()) << of.on << b.status.cause;
    EXPECT_GT(b.friction_work, 1e-3) << of.on;
    EXPECT_LT(b.work, -1e-2) << of.on;
    EXPECT_NEAR(b.end - b.start, b.work, 1e-6 * std::abs(b.work)) << of.on;
  }
}

// A body with corners or ends in place of the ball, which tumbles, or a wheel that leans.
TEST(Contact, OfSeveralPointsTakesExactlyItsWork) {
  struct Case {
    const char *points, *on, *start;
  };
  for (const Case& of :
       {Case{"shape='box' size='0.2 0.1 0.06'", "shape='plane'",
             "translation: [0, 0, 0.3], rotation: [0.3, 0.2, 0.1]"},
        Case{"shape='capsule' radius='0.03' length='0.1'", "shape='bore' radius='0.2'",
             "translation: [0.05, 0, 0], linear_velocity: [1, 0, 0], rotation: [0.9, "
             "0.2, 0.1]"},
        Case{"shape='disc' radius='0.1'", "shape='plane'",
             "translation: [0, 0, 0.11], rotation: [1.2, 0, 0], linear_velocity: "
             "[1, 0, 0], angular_velocity: [0, 9, 0]"}}) {
    const Balance b = balance(
        free_ball("",
                  "<codesign:contact name='touch' stiffness='1e6' dissipation='0.3'><predecessor "
                  "link='ground' " +
                      std::string(of.on) + "/><successor link='ball' " + of.points +
                      "/><codesign:friction mu_static='0.2' mu_dynamic='0.15' "
                      "transition_velocity='0.05'/></codesign:contact>"),
        "duration: 0.4\ninitial_state: {free: {" + std::string(of.start) +
            "}}\nobjective: {integral: [{signal: ball/velocity/z}]}\nsolver: " + kFriction + "\n");
    ASSERT_TRUE(b.status.ok()) << of.points << b.status.cause;
    EXPECT_GT(b.friction_work, 1e-3) << of.points;
    EXPECT_NEAR(b.end - b.start, b.work, 1e-6 * std::abs(b.work)) << of.points;
  }
}

// For arrows and messages: the whole force on the ball, where it acts.
TEST(Contact, AFrameHasItsForce) {
  const double depth = std::pow(kGravity / 1e6, 2.0 / 3.0);
  const Problem problem = problem_of(
      free_ball("", touching_ground("shape='plane'", "",
                                    "<codesign:friction mu_static='0.3' mu_dynamic='0.3'/>")),
      "duration: 0.1\ninitial_state: {free: {translation: [0.2, 0, " +
          std::to_string(kRadius - depth) + "], linear_velocity: [1, 0, 0]}}\n");
  Simulation simulation(problem, problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  ASSERT_EQ(simulation.names().frictions, std::vector<std::string>{"touch"});
  EXPECT_FALSE(simulation.names().friction_is_torque[0]);
  Frame frame;
  simulation.sample(0.0, &frame);
  const FrictionSample& sample = frame.frictions[0];
  EXPECT_NEAR(sample.normal_force, kGravity, 0.3);
  EXPECT_NEAR(sample.friction, -0.3 * sample.normal_force, 1e-9);
  EXPECT_NEAR(sample.sliding_velocity, 1.0, 1e-12);
  const Eigen::Vector3d force(sample.friction, 0.0, sample.normal_force);
  EXPECT_LT((sample.force - force).norm(), 1e-9);
  EXPECT_LT((sample.position - Eigen::Vector3d(0.2, 0.0, -0.5 * depth)).norm(), 1e-6);
}

// A journal of 10 mm in a bearing that is wider by the clearance, in place of a hinge.
TEST(Contact, AHingeWithClearanceIsNearlyAHinge) {
  const double duration = 0.7;
  const std::string link = bar("arm"), start = "duration: 0.7\ninitial_state: {j: {";
  const std::vector<double> ideal =
      signals_at(problem_of(robot(link + hinge("j", "ground", "arm", "0 0 0")),
                            start + "position: 0.5}}\nsolver: {relative_tolerance: 1.0e-9}\n"),
                 duration, {"arm/velocity/x", "arm/angular_velocity/y"});
  double last = 0.0;
  for (const double clearance : {1e-3, 1e-5}) {
    const Problem problem = problem_of(
        robot(link +
              "<joint name='j' type='planar'><parent link='ground'/><child link='arm'/><axis "
              "xyz='0 1 0'/></joint><codesign:contact name='bearing' stiffness='1e8' "
              "dissipation='2'><predecessor link='ground' shape='bore' radius='" +
              std::to_string(0.01 + clearance) +
              "'><origin rpy='1.5707963267948966 0 0'/></predecessor><successor link='arm' "
              "shape='sphere' radius='0.01'/></codesign:contact>"),
        start + "rotation: 0.5}}\nsolver: {relative_tolerance: 1.0e-8}\n");
    const std::vector<double> end = signals_at(
        problem, duration, {"arm/velocity/x", "arm/angular_velocity/y", "bearing/normal_force"});
    last = std::abs(end[1] - ideal[1]);
    EXPECT_LT(last, 60.0 * clearance + 1e-3) << clearance;
    EXPECT_GT(end[2], 1.0) << "it hangs in its bearing";
  }
  EXPECT_LT(last, 2e-3);
}

// Both bodies move; a box has the surface, and a sphere beside the centre of mass touches it.
TEST(Contact, ActsOnBothBodiesAndKeepsTheirMomentum) {
  const std::string urdf = robot(
      "<link name='a'><inertial><mass value='2'/><inertia ixx='0.02' ixy='0' ixz='0' iyy='0.03' "
      "iyz='0' izz='0.01'/></inertial></link><joint name='fa' type='floating'><parent "
      "link='ground'/><child link='a'/></joint><link name='b'><inertial><mass value='1'/><inertia "
      "ixx='0.002' ixy='0' ixz='0' iyy='0.001' iyz='0' izz='0.003'/></inertial></link><joint "
      "name='fb' type='floating'><parent link='ground'/><child link='b'/></joint><codesign:contact "
      "name='hit' stiffness='1e5' dissipation='0.2'><predecessor link='a' shape='sphere' "
      "radius='0.1'><origin xyz='0.02 0.01 0'/></predecessor><successor link='b' shape='box' "
      "size='0.2 0.1 0.1'/><codesign:friction mu_static='0.4' mu_dynamic='0.3'/>"
      "</codesign:contact>");
  for (const char* coordinates : {"joint", "absolute"}) {
    const Problem problem = problem_of(
        urdf,
        "duration: 0.3\ngravity: [0, 0, 0]\ninitial_state: {fa: {translation: [-0.4, 0, 0], "
        "linear_velocity: [2, 0, 0.1], angular_velocity: [0, 3, 1]}, fb: {translation: [0, 0.02, "
        "0.03]}}\nsolver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-12, "
        "coordinates: " +
            std::string(coordinates) + "}\n");
    std::vector<std::string> signals;
    for (const char* link : {"a", "b"})
      for (const char* quantity : {"position", "velocity", "angular_velocity"})
        for (const char* axis : {"x", "y", "z"})
          signals.push_back(std::string(link) + "/" + quantity + "/" + axis +
                            (quantity == std::string("angular_velocity") ? "@" + std::string(link)
                                                                         : std::string()));
    for (const char* link : {"a", "b"})
      for (const char* part : {"w", "x", "y", "z"})
        signals.push_back(std::string(link) + "/orientation/" + part);
    Simulation simulation(problem, problem.parameters(), signals);
    ASSERT_TRUE(simulation.start().ok());
    Frame frame;
    const auto momenta = [&](double time) {
      simulation.sample(time, &frame);
      const double* const s = frame.signals.data();
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector3d at(s + 9 * k), velocity(s + 9 * k + 3), spin(s + 9 * k + 6);
        const double mass = k == 0 ? 2.0 : 1.0;
        const Eigen::Vector3d inertia =
            k == 0 ? Eigen::Vector3d(0.02, 0.03, 0.01) : Eigen::Vector3d(0.002, 0.001, 0.003);
        const double* const q = s + 18 + 4 * k;
        sum.head<3>() += mass * velocity;
        sum.tail<3>() += mass * at.cross(velocity) +
                         Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * inertia.cwiseProduct(spin);
      }
      return sum;
    };
    const Eigen::Matrix<double, 6, 1> before = momenta(0.0);
    ASSERT_TRUE(simulation.advance_to(0.3).ok());
    EXPECT_LT((momenta(0.3) - before).norm(), 1e-9) << coordinates;
    EXPECT_GT(frame.signals[12], 0.5) << "b was hit";
    ASSERT_GE(simulation.events().list.size(), 2U);
    EXPECT_EQ(simulation.events().list[0].element, "contact \"hit\"");
    EXPECT_EQ(simulation.events().list[0].expression, "touch");
    EXPECT_TRUE(simulation.events().list[0].rising);
    EXPECT_FALSE(simulation.events().list[0].jump);
    EXPECT_FALSE(simulation.events().list[1].rising);
  }
}

}  // namespace
}  // namespace codesign
