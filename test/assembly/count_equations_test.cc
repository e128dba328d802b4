// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/counts.h"

#include <gtest/gtest.h>

#include "assembly/count_equations.h"
#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

Counts counts_of(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  const auto system = make_system(robot, read_study({"test.yaml", study}, robot));
  Status status;
  const Counts counts = count_equations(*system, system->parameters(), &status);
  EXPECT_TRUE(status.ok()) << status.cause;
  return counts;
}

TEST(Counts, OfADoublePendulumWithAnIntegralAndTwoParameters) {
  const Counts c =
      counts_of(double_pendulum(), let_go("{}", "elbow/velocity",
                                          "parameters: {k: {initial: 1.0}, l: {initial: 2.0}}\n"
                                          "controllers: {servo: {type: pid, input: elbow/position, setpoint: 0.0, output: elbow, "
                                          "gains: {p: \"${k}\", i: \"${l}\"}}}\n"));
  EXPECT_EQ(c.bodies, 2);
  EXPECT_EQ(c.coordinates, 14);
  EXPECT_EQ(c.first_order_equations, 28);
  EXPECT_EQ(c.controller_states, 1);
  EXPECT_EQ(c.degrees_of_freedom, 2);
  EXPECT_EQ(c.constraints, 12);
  EXPECT_EQ(c.redundant_constraints, 0);
  EXPECT_EQ(c.dynamic_equations, 40);
  EXPECT_EQ(c.parameters, 2);
  EXPECT_EQ(c.sensitivities, 80);
  EXPECT_EQ(c.total_equations, 120);
}

TEST(Counts, RedundantRowsAreNamedAndDoNotTakeFreedom) {
  const Counts c = counts_of(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"));
  EXPECT_EQ(c.degrees_of_freedom, 1);
  EXPECT_EQ(c.redundant_constraints, 3);
  ASSERT_EQ(c.redundant_rows.size(), 3U);
  for (const ConstraintRow& row : c.redundant_rows) {
    EXPECT_EQ(row.joint, "right_pin") << "the loop is what could be left out";
    EXPECT_FALSE(row.kind.empty());
  }
}

}  // namespace
}  // namespace codesign
