// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/articulated_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The largest acceleration at one state, and the largest difference between the library and the
/// articulated-body algorithm.
struct Comparison {
  double size = 0.0, difference = 0.0;
};

Comparison compare(const Robot& robot, const char* solver, double phase) {
  const auto n = static_cast<Eigen::Index>(robot.links.size());
  Eigen::VectorXd q(n), v(n), expected(n);
  std::string start;
  const GeneratedCase files = robot_case(robot, solver);
  Study study = study_of(load_problem(files.urdf, {}, files.study));
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto x = static_cast<double>(k);
    study.initial_state[static_cast<std::size_t>(k)].position = q[k] = std::sin(phase + 7.0 * x);
    study.initial_state[static_cast<std::size_t>(k)].velocity = v[k] = std::cos(phase + 5.0 * x);
  }
  const Problem problem = with_study(load_problem(files.urdf, {}, files.study), study);
  Simulation simulation(problem, problem.parameters());
  const Status status = simulation.start();
  EXPECT_TRUE(status.ok()) << status.cause;
  Frame frame;
  simulation.sample(0.0, &frame);
  ArticulatedBody(robot).accelerations(q.data(), v.data(), expected.data());
  Comparison comparison;
  for (Eigen::Index k = 0; k < n; ++k) {
    comparison.size = std::max(comparison.size, std::abs(expected[k]));
    comparison.difference =
        std::max(comparison.difference,
                 std::abs(frame.joints[static_cast<std::size_t>(k)].acceleration - expected[k]));
  }
  return comparison;
}

TEST(ArticulatedBody, AcceleratesTreesAsJointCoordinatesDo) {
  for (const Robot& robot : all_robots())
    for (double phase : {0.3, 1.1, 2.0}) {
      const Comparison comparison = compare(robot, "coordinates: joint", phase);
      EXPECT_LT(comparison.difference, 1e-11 * comparison.size) << robot.name << " " << phase;
    }
}

TEST(ArticulatedBody, AcceleratesTreesAsAbsoluteCoordinatesDo) {
  for (const Robot& robot : {ur5(), panda()}) {
    const Comparison comparison = compare(robot, "coordinates: absolute", 0.7);
    EXPECT_LT(comparison.difference, 1e-10 * comparison.size) << robot.name;
  }
}

// A bar on a hinge about y: I q'' = -m g l sin q - c q' - f tanh(4 q' / 0.01) with I about the
// hinge.
TEST(ArticulatedBody, SwingsAPendulum) {
  const double length = 0.3, mass = 2.0, q = 0.5, v = -0.004;
  const Robot robot{
      "pendulum",
      1.0,
      1e-6,
      {{"bar", -1, 'y', false, {}, {}, mass, {0, 0, -length}, {0.1, 0.1, 0.6}, 0.2, 0.3, 0.0}}};
  double a = 0.0;
  ArticulatedBody(robot).accelerations(&q, &v, &a);
  const double I = mass * (0.1 * 0.1 + 0.6 * 0.6) / 12.0 + mass * length * length;
  EXPECT_NEAR(a, (-mass * 9.81 * length * std::sin(q) - 0.2 * v - 0.3 * std::tanh(400.0 * v)) / I,
              1e-12);
}

// A mass on a slide along x that is turned to point down, and a turntable that does not matter to
// it.
TEST(ArticulatedBody, LetsASliderFall) {
  const Robot robot{"slide",
                    1.0,
                    1e-6,
                    {{"table", -1, 'z', false, {}, {}, 1.0, {}, {0.1, 0.1, 0.1}, 0.0, 0.0, 0.0},
                     {"mass",
                      0,
                      'x',
                      true,
                      {0, 0, 1},
                      {0, 1.5707963267948966, 0},
                      2.0,
                      {},
                      {0.1, 0.1, 0.1},
                      0.5,
                      0.0,
                      0.0}}};
  const double q[] = {0.2, 0.1}, v[] = {0.0, 3.0};
  double a[2];
  ArticulatedBody(robot).accelerations(q, v, a);
  EXPECT_NEAR(a[0], 0.0, 1e-12);
  EXPECT_NEAR(a[1], 9.81 - 0.5 * 3.0 / 2.0, 1e-12);
}

}  // namespace
}  // namespace codesign
