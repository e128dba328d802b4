// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Linkages whose constraints are redundant move as their closed forms say.
#include "integration/linkages.h"

#include <gtest/gtest.h>

#include "assembly/count_equations.h"
#include "integration/driven_slides.h"
#include "integration/energy_balance.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

TEST(Linkages, RowsOfFourBarsSwingAsTheirPlanarEquationSays) {
  for (int count : {1, 4}) {
    const auto system = compile(four_bar_row(count),
                                motion_study(1.5, "{bar0_hinge: {position: 0.6, velocity: 1.0}}",
                                             "bar0_hinge/velocity", kTight));
    Status status;
    const Counts counts = count_equations(*system, {}, &status);
    ASSERT_TRUE(status.ok()) << status.cause;
    EXPECT_EQ(counts.degrees_of_freedom, 1);
    EXPECT_EQ(counts.redundant_constraints, 3 * count);
    Simulation simulation =
        simulation_of(system, {}, parsed_signals({"bar0_hinge/position", "bar1_hinge/position"}));
    status = simulate(&simulation, 1.5, 6, [&](const Frame& frame) {
      const auto f = [count](double theta) { return four_bar_row_acceleration(count, theta); };
      const double theta = frame.time == 0.0 ? 0.6 : reference_angle(f, 0.6, 1.0, frame.time);
      EXPECT_NEAR(frame.signals[0], theta, 1e-7) << count << " at " << frame.time;
      EXPECT_NEAR(frame.signals[1], theta, 1e-7);
      for (double error : frame.loop_errors) EXPECT_LT(error, 1e-9);
      return true;
    });
    EXPECT_TRUE(status.ok()) << status.cause;
  }
}

TEST(Linkages, ABricardRingKeepsToItsClosedForm) {
  const auto system =
      compile(bricard(), motion_study(2.0, bricard_start(1.2, 0.7), "turn1/velocity", kTight));
  Status status;
  const Counts counts = count_equations(*system, {}, &status);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(counts.degrees_of_freedom, 1);
  EXPECT_EQ(counts.redundant_constraints, 1);
  double least = 10.0, most = -10.0;
  Simulation simulation =
      simulation_of(system, {},
                    parsed_signals({"turn1/position", "turn2/position", "turn3/position",
                                    "turn4/position", "turn5/position"}));
  status = simulate(&simulation, 2.0, 41, [&](const Frame& frame) {
    const std::vector<double>& theta = frame.signals;
    least = std::min(least, theta[0]);
    most = std::max(most, theta[0]);
    EXPECT_NEAR(theta[2], theta[0], 1e-7);
    EXPECT_NEAR(theta[4], theta[0], 1e-7);
    EXPECT_NEAR(theta[3], theta[1], 1e-7);
    EXPECT_NEAR(std::cos(theta[0]) + std::cos(theta[1]) + std::cos(theta[0]) * std::cos(theta[1]),
                0.0, 1e-7)
        << frame.time;
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  EXPECT_GT(most - least, 0.5) << "it has moved";
}

TEST(Linkages, ABricardRingConservesEnergy) {
  const Balance b =
      balance(bricard(), motion_study(2.0, bricard_start(1.2, 0.7), "turn1/velocity", kTight));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-7);
}

}  // namespace
}  // namespace codesign
