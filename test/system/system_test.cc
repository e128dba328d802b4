// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_system.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"

namespace codesign {
namespace {

CompiledSystem compile(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return CompiledSystem(robot, read_study({"test.yaml", study}, robot));
}

/// A hinged bar with a controller of these gains; `objective` is the list of integral terms.
CompiledSystem controlled(const std::string& gains, const std::string& input,
                          const std::string& objective) {
  return compile(pendulum(), "duration: 1.0\ncontrollers: {hold: {type: pid, input: " + input +
                                 ", setpoint: 0.0, output: hinge, gains: " + gains +
                                 "}}\nobjective: {integral: " + objective + "}\n");
}

const std::string kSwing = "[{signal: hinge/velocity}]";

TEST(CompiledSystem, LaysOutBodiesPairsAndNorms) {
  const CompiledSystem system =
      compile(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"));
  const Layout& layout = system.layout();
  EXPECT_EQ(layout.bodies, 3);
  EXPECT_EQ(layout.n, 21);
  EXPECT_EQ(layout.m, 4 * 5 + 3);
  EXPECT_EQ(layout.pair_row, (std::vector<int>{0, 5, 10, 15}));
  EXPECT_EQ(layout.norm_row(0), 20);
  EXPECT_EQ(layout.columns(), 44);
}

TEST(CompiledSystem, AnIntegralIsAStateOnlyIfSomethingReadsIt) {
  EXPECT_EQ(controlled("{p: 1.0}", "hinge/position", kSwing).layout().states, 0);
  EXPECT_EQ(controlled("{p: 1.0, i: 1.0}", "hinge/position", kSwing).layout().states, 1);
  EXPECT_EQ(controlled("{p: 1.0}", "hinge/position", "[{signal: hold/integral}]").layout().states,
            1);
}

TEST(CompiledSystem, ADifferentialGainNeedsARateThatExists) {
  EXPECT_TRUE(
      controlled("{p: 1.0}", "hinge/position", kSwing).controllers().at(0).input_rate.empty());
  EXPECT_EQ(
      controlled("{d: 1.0}", "hinge/position", kSwing).controllers().at(0).input_rate.at(0).kind,
      SignalKind::kJointVelocity);
  EXPECT_NO_THROW(controlled("{d: 1.0}", "bar/angular_velocity/y", kSwing));
  EXPECT_THROW(controlled("{d: 1.0}", "bar/acceleration/y", kSwing), InputError);
}

TEST(CompiledSystem, AControllerCannotReadWhatItCauses) {
  EXPECT_THROW(controlled("{p: 1.0}", "hinge/effort", kSwing), InputError);
  EXPECT_THROW(controlled("{p: 1.0}", "hold/output", kSwing), InputError);
}

TEST(CompiledSystem, OnlyJointsWithALoadAreListed) {
  EXPECT_TRUE(compile(pendulum(), let_go("{}", "hinge/velocity")).loads().empty());
  const CompiledSystem system =
      compile(double_pendulum(pin_friction()), let_go("{}", "elbow/velocity"));
  ASSERT_EQ(system.loads().size(), 2U);
  EXPECT_TRUE(system.loads()[0].find<BearingFriction>());
  EXPECT_FALSE(system.loads()[0].find<PassiveLoad>());
  const CompiledSystem driven = controlled("{p: 1.0}", "hinge/position", kSwing);
  ASSERT_EQ(driven.loads().size(), 1U);
  ASSERT_TRUE(driven.loads()[0].find<ControllerEffort>());
  EXPECT_EQ(driven.loads()[0].find<ControllerEffort>()->controllers, std::vector<int>{0});
}

TEST(CompiledSystem, ThePatternHoldsTheIntegrandBelowTheEquations) {
  const CompiledSystem system = compile(pendulum(), let_go("{}", "hinge/velocity"));
  EXPECT_EQ(system.patterns().rate.columns, system.layout().columns());
  // The hinge's rate is read off p and p' of the bar alone.
  const Sparsity& velocity = system.patterns().velocity;
  const int g = velocity.rows - 1;
  EXPECT_EQ(g, system.layout().columns());
  EXPECT_EQ(velocity.first(g + 1) - velocity.first(g), 4);
  for (int e = velocity.first(g); e < velocity.first(g + 1); ++e) {
    EXPECT_GE(velocity.column(e), 3);
    EXPECT_LT(velocity.column(e), 7);
  }
}

}  // namespace
}  // namespace codesign
