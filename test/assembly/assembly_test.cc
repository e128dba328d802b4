// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/loops_to_close.h"
#include "description/study.h"

namespace codesign {
namespace {

using C = std::complex<double>;
constexpr double kCompliance = 1e-9;

double largest_gap(Compiled* c) {
  Eigen::VectorXd errors, rates;
  c->equations.constraint_errors(c->state, &errors, &rates);
  return std::max(errors.cwiseAbs().maxCoeff(), rates.cwiseAbs().maxCoeff());
}

TEST(Assembly, GivenPositionsStayAndTheLoopIsClosed) {
  Compiled c(four_bar(),
             let_go("{left_hinge: {position: 0.6, velocity: 2.0}}", "left_hinge/velocity"),
             kCompliance);
  ASSERT_TRUE(c.start().ok());
  // A parallelogram: the other bar turns along, the coupler stays level.
  EXPECT_NEAR(c.assembly.theta()[0], 0.6, 1e-15);
  EXPECT_NEAR(c.assembly.theta()[1], 0.6, 1e-12);
  EXPECT_NEAR(c.assembly.theta()[2], -0.6, 1e-12);
  Eigen::VectorXd errors, rates;
  c.equations.constraint_errors(c.state, &errors, &rates);
  EXPECT_LT(errors.cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(rates.cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Assembly, ATimeAndPositionsToBeginWithTakeThePlaceOfTheStudys) {
  const double below = std::asin(0.6), above = 3.141592653589793 - below;
  Compiled c(
      triangle(),
      let_go("{left_hinge: {guess: -0.5}, right_hinge: {guess: 0.5}}", "left_hinge/velocity"),
      kCompliance);
  c.assembly.begin_at(1.5, Eigen::Vector2d(-2.6, 2.6));
  ASSERT_TRUE(c.start().ok());
  EXPECT_EQ(c.state.t, 1.5);
  EXPECT_NEAR(c.assembly.theta()[0], -above, 1e-12);
  c.assembly.begin_at(0.0, {});
  ASSERT_TRUE(c.start().ok());
  EXPECT_EQ(c.state.t, 0.0);
  EXPECT_NEAR(c.assembly.theta()[0], -below, 1e-12);
}

TEST(Assembly, ExtraStatesBeginWhereTheStudySays) {
  const RobotDescription robot = read_urdf({"test.urdf", pendulum()});
  Study study = read_study({"test.yaml",
                            "duration: 1.0\ncontrollers: {servo: {type: pid, input: "
                            "hinge/position, setpoint: 0.0, output: hinge, "
                            "gains: {i: 2.0}}}\nparameters: {start: {initial: 0.75}}\n"},
                           robot);
  study.initial_extra_states = {Quantity(
      0.75, std::make_shared<const Expression>("start", std::vector<std::string>{"start"}))};
  const CompiledSystem system(robot, study);
  Equations<double> equations(system);
  Assembly assembly(system);
  State<double> state;
  equations.set_design(system.parameters());
  ASSERT_TRUE(assembly.solve(system.parameters(), &equations, &state).ok());
  ASSERT_EQ(state.s.size(), 1);
  EXPECT_EQ(state.s[0], 0.75);
  Equations<C> complex(system);
  const std::vector<C> parameters{C(0.75, 1e-30)};
  complex.set_design(parameters);
  State<C> extended;
  assembly.extend(parameters, state, &complex, &extended);
  EXPECT_EQ(extended.s[0].imag(), 1e-30);
}

TEST(Assembly, AGuessChoosesTheBranch) {
  // The tips meet below the hinges or above them, half way between.
  const double below = std::asin(0.6), above = 3.141592653589793 - below;
  for (double angle : {below, above}) {
    const std::string guess = angle == below ? "0.5" : "2.6";
    Compiled c(triangle(),
               let_go("{left_hinge: {guess: -" + guess + "}, right_hinge: {guess: " + guess + "}}",
                      "left_hinge/velocity"),
               kCompliance);
    ASSERT_TRUE(c.start().ok());
    EXPECT_NEAR(c.assembly.theta()[0], -angle, 1e-12);
    EXPECT_NEAR(c.assembly.theta()[1], angle, 1e-12);
  }
}

TEST(Assembly, ALoopThatCannotBeClosedIsAStatusThatNamesIt) {
  Compiled c(triangle("2.5"), let_go("{left_hinge: {guess: -0.5}}", "left_hinge/velocity"));
  const Status status = c.start();
  EXPECT_EQ(status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(status.cause.find("'tip'"), std::string::npos);
  EXPECT_EQ(c.assembly.worst_miss().owner, "tip");
}

TEST(Assembly, ObeysACancel) {
  Compiled c(
      triangle(),
      let_go("{left_hinge: {guess: -0.5}, right_hinge: {guess: 0.5}}", "left_hinge/velocity"),
      kCompliance);
  const std::atomic<bool> cancel{true};
  c.assembly.obey(&cancel);
  EXPECT_EQ(c.start().code, StatusCode::kCancelled);
  c.assembly.obey(nullptr);
  ASSERT_TRUE(c.start().ok());
  c.assembly.obey(&cancel);
  EXPECT_EQ(c.assembly.rates().solve(&c.equations, &c.state).code, StatusCode::kCancelled);
}

TEST(Assembly, VelocitiesThatContradictEachOtherAreAStatus) {
  Compiled c(four_bar(), let_go("{left_hinge: {position: 0.6, velocity: 1.0}, right_hinge: "
                                "{velocity: 2.0}, left_pin: {velocity: 0.0}}",
                                "left_hinge/velocity"));
  EXPECT_EQ(c.start().code, StatusCode::kInitialVelocityFailed);
}

TEST(Assembly, AccelerationsAndReactionsBalance) {
  Compiled c(pendulum(), let_go("{hinge: {position: 0.4, velocity: 3.0}}", "hinge/velocity"));
  ASSERT_TRUE(c.start().ok());
  Eigen::VectorXd G;
  double g = 0.0;
  c.equations.residual(c.state, &G, &g);
  EXPECT_LT(G.cwiseAbs().maxCoeff(), 1e-12);
  // (I + m c^2) theta'' = -m g c sin(theta) about y, with the centre at -c z.
  const double angular = -9.81 * 0.5 * std::sin(0.4) / (0.0834 + 0.25);
  EXPECT_NEAR(c.state.z[0], -0.5 * (angular * std::cos(0.4) - 9.0 * std::sin(0.4)), 1e-12);
}

TEST(Assembly, InitialSensitivitiesAreThoseOfTheAssembledStart) {
  const std::string study =
      let_go("{left_hinge: {guess: -0.6}, right_hinge: {guess: 0.6}}", "left_hinge/velocity");
  Compiled c(triangle(), study, kCompliance);
  ASSERT_TRUE(c.start().ok());
  Equations<C> extended(c.system);
  const double step = 1e-30, h = 1e-5;
  const std::vector<C> parameters{C(1.0, step)};
  extended.set_design(parameters);
  State<C> moved;
  c.assembly.extend(parameters, c.state, &extended, &moved);
  Compiled plus(triangle(), study, kCompliance), minus(triangle(), study, kCompliance);
  ASSERT_TRUE(plus.start({1.0 + h}).ok() && minus.start({1.0 - h}).ok());
  const Eigen::VectorXd q_rho = moved.q.imag() / step;
  EXPECT_GT(q_rho.norm(), 0.1) << "a length changes the assembly";
  EXPECT_LT((q_rho - (plus.state.q - minus.state.q) / (2.0 * h)).norm(), 1e-8);
  const Eigen::VectorXd z_rho = moved.z.imag() / step;
  EXPECT_LT((z_rho - (plus.state.z - minus.state.z) / (2.0 * h)).norm(),
            1e-6 * (1.0 + z_rho.norm()));
}

TEST(Assembly, TheStudysCoordinateStaysAndTheOthersClose) {
  Compiled c(four_bar(),
             let_go("{left_hinge: {position: 0.6, velocity: 2.0}}", "left_hinge/velocity"),
             kCompliance);
  ASSERT_TRUE(c.start().ok());
  // Somewhere else on the way, with the coupler a little off.
  TreeCoordinates from{c.assembly.theta(), Eigen::VectorXd::Zero(3)};
  from.theta << 1.1, 1.12, -1.09;
  from.rate << 0.7, 0.6, -0.9;
  c.state.t = 0.4;
  ASSERT_TRUE(c.assembly.solve_from(from, {}, &c.equations, &c.state).ok());
  EXPECT_EQ(c.state.t, 0.4);
  EXPECT_NEAR(c.assembly.theta()[0], 1.1, 1e-15);
  EXPECT_NEAR(c.assembly.theta()[1], 1.1, 1e-11);
  EXPECT_NEAR(c.assembly.theta()[2], -1.1, 1e-11);
  EXPECT_LT(largest_gap(&c), 1e-11);
  TreeCoordinates found;
  ASSERT_EQ(tree_coordinates(c.system, c.assembly.tree(), c.state, c.assembly.theta(), &c.equations,
                             &found),
            "");
  EXPECT_NEAR(found.rate[0], 0.7, 1e-12);
  EXPECT_NEAR(found.rate[2], -0.7, 1e-11);
  // The next start is the study's again.
  ASSERT_TRUE(c.start().ok());
  EXPECT_NEAR(c.assembly.theta()[1], 0.6, 1e-12);
}

TEST(Assembly, PositionsThatFitTheStartAloneAreReleased) {
  Compiled c(
      four_bar(),
      let_go(
          "{left_hinge: {position: 0.6}, right_hinge: {position: 0.6}, left_pin: {position: -0.6}}",
          "left_hinge/velocity"),
      kCompliance);
  ASSERT_TRUE(c.start().ok());
  TreeCoordinates from{c.assembly.theta(), Eigen::VectorXd::Zero(3)};
  from.theta << 0.7, 0.72, -0.71;
  ASSERT_TRUE(c.assembly.solve_from(from, {}, &c.equations, &c.state).ok());
  EXPECT_LT(largest_gap(&c), 1e-11);
}

}  // namespace
}  // namespace codesign
