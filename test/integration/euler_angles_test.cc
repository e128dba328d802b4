// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A top on a ball joint of three hinges, read by proper Euler angles.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

Problem top(const std::string& start, const std::string& axes = "") {
  const std::string third = axes.empty() ? "0 0 1" : axes;
  return load_problem(
      {"top.urdf",
       R"(<robot name="top"><link name="g"/><link name="m1"/><link name="m2"/><link name="b"><inertial>
       <origin xyz="0 0 0.1"/><mass value="0.5"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001"
       iyz="0" izz="0.0008"/></inertial></link><joint name="rz" type="continuous"><parent link="g"/>
       <child link="m1"/><axis xyz="0 0 1"/></joint><joint name="rx" type="continuous"><parent
       link="m1"/><child link="m2"/><axis xyz="1 0 0"/></joint><joint name="sp" type="continuous">
       <parent link="m2"/><child link="b"/><axis xyz=")" +
           third + R"("/></joint></robot>)"},
      {},
      {"top.yaml",
       "duration: 0.5\nsolver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n"
       "initial_state: " +
           start + "\n"});
}

const std::vector<std::string> kAngles = {"rz/position", "rx/position", "sp/position",
                                          "rz/velocity", "rx/velocity", "sp/velocity"};

std::vector<std::vector<double>> angles_of(const Problem& problem, int count) {
  Simulation simulation(problem, problem.parameters(), kAngles);
  std::vector<std::vector<double>> rows;
  const Status status = simulate(&simulation, problem.duration(), count, [&](const Frame& frame) {
    rows.push_back(frame.signals);
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return rows;
}

// The angular momentum about the vertical and about the top's axis stay: with theta = rx, phi' =
// rz', psi' = sp' (Goldstein, Classical Mechanics, 5.7).
TEST(EulerAngles, AHeavyTopKeepsItsAngularMomenta) {
  constexpr double kAcross = 0.001 + 0.5 * 0.01, kAlong = 0.0008;
  for (const char* tilt : {"0.5", "-0.5", "2.6", "-2.6"}) {
    const std::vector<std::vector<double>> rows =
        angles_of(top(std::string("{rz: {position: 0.4}, rx: {position: ") + tilt +
                      "}, sp: {position: -1, velocity: 150}}"),
                  1001);
    ASSERT_EQ(rows.size(), 1001U);
    EXPECT_NEAR(rows[0][0], 0.4, 1e-9);
    EXPECT_NEAR(rows[0][1], std::stod(tilt), 1e-9);
    EXPECT_NEAR(rows[0][2], -1.0, 1e-9);
    EXPECT_NEAR(rows[0][5], 150.0, 1e-6);
    const auto momenta = [](const std::vector<double>& row) {
      const double c = std::cos(row[1]), s = std::sin(row[1]), spin = row[5] + row[3] * c;
      return Eigen::Vector2d(kAlong * spin, kAcross * row[3] * s * s + kAlong * spin * c);
    };
    const Eigen::Vector2d begun = momenta(rows[0]);
    for (std::size_t k = 1; k + 1 < rows.size(); ++k) {
      EXPECT_LT((momenta(rows[k]) - begun).norm(), 1e-5 * begun.norm()) << tilt;
      for (std::size_t angle = 0; angle < 3; ++angle)
        EXPECT_NEAR((rows[k + 1][angle] - rows[k - 1][angle]) / 0.001, rows[k][angle + 3],
                    2e-3 * (1.0 + std::abs(rows[k][angle + 3])))
            << tilt << " " << kAngles[angle];
    }
  }
}

TEST(EulerAngles, ATopThatStandsUprightHasNoneAndTheMessageSaysWhatItNeeds) {
  try {
    angles_of(top("{sp: {velocity: 150}}"), 2);
    ADD_FAILURE() << "read";
  } catch (const InputError& error) {
    for (const char* part : {"proper Euler angles", "initial_state", "no multiple of pi"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_EQ(angles_of(top("{sp: {velocity: 5}}", "0 1 0"), 2).size(), 2U)
      << "Tait-Bryan angles need none";
}

}  // namespace
}  // namespace codesign
