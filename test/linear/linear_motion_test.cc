// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_motion.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "math/dense.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::string link(const std::string& name) {
  return "<link name=\"" + name +
         R"("><inertial><origin xyz="0 0 -0.5"/><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1"
           ixy="0" ixz="0" iyz="0"/></inertial></link>)";
}

/// A bar whose servo is sampled, with a delay of one and a half samples; beside it a link that
/// follows by a rod.
Problem machine(const std::string& keys = "") {
  const std::string urdf =
      R"(<robot name="m" xmlns:codesign="urn:mechanism_codesign"><link name="base"/>)" +
      link("bar") + link("follower") +
      R"(<joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/></joint>
         <joint name="pivot" type="continuous"><parent link="base"/><child link="follower"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
         <loop name="rod" type="codesign:distance"><predecessor link="bar"><origin xyz="0 0 -1"/></predecessor>
           <successor link="follower"><origin xyz="0 0 -1"/></successor><codesign:length value="1"/></loop></robot>)";
  return load_problem({"m.urdf", urdf}, {},
                      {"s.yaml",
                       "duration: 1\ninitial_state: {hinge: {position: 0.3, velocity: 1.5}, pivot: "
                       "{guess: 0.3}}\ncontrollers: {servo: {type: pid, input: hinge/position, "
                       "setpoint: 0.2, output: hinge, gains: {p: 20, d: 2}" +
                           keys + "}}\n"});
}

struct Case {
  Problem problem;
  LinearStudy study;
  CompiledSystem system;
  LinearMotion motion;

  explicit Case(const std::string& keys = "")
      : problem(machine(keys)),
        study(with_inputs(system_of(problem)->whole_study(), problem.parameters(), 0.0, false)),
        system(system_of(problem)->robot(), study.study, system_of(problem)->sharing()),
        motion(system, study) {}

  State<double> start() const {
    StartWorkspace start(*system_of(problem), problem.parameters());
    EXPECT_TRUE(start.solve().ok());
    return start.state;
  }
};

// Phi_q Q = 0, the rows of y in Q are those of the identity, and the constraints' rates stay zero.
TEST(LinearMotion, CoordinatesKeepTheConstraints) {
  Case of;
  ASSERT_TRUE(of.motion.linearize(of.start()).ok());
  const LinearCoordinates& y = of.motion.coordinates();
  ASSERT_EQ(y.columns.size(), 1U);
  EXPECT_NEAR(y.Q(y.columns[0], 0), 1.0, 1e-14);
  EXPECT_NEAR(y.P(y.columns[0], 0), 0.0, 1e-14);
  EXPECT_EQ(linear_state_names(of.system, y.columns),
            (std::vector<std::string>{"hinge/position", "hinge/velocity"}));
  // A finite step along (Q, P) leaves Phi and Phi_q v zero to second order.
  constexpr double kStep = 1e-5;
  State<double> moved = of.motion.state();
  moved.q += kStep * y.Q.col(0);
  moved.v += kStep * y.P.col(0);
  VectorX<double> Phi, rate;
  of.motion.equations().constraint_errors(moved, &Phi, &rate);
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT(rate.cwiseAbs().maxCoeff(), 1e-8);
}

// Bars of a parallelogram move alike: (0.6 + 0.6) y'' = -2 m g l sin(y) + u.
TEST(LinearMotion, OfAParallelogram) {
  Case of;
  ASSERT_TRUE(of.motion.linearize(of.start()).ok());
  const StateSpace& flow = of.motion.flow();
  const double gravity = 2.0 * 2.0 * 9.81 * 0.5 * std::cos(0.3);
  EXPECT_NEAR(flow.A(1, 0), -(gravity + 20.0) / 1.2, 1e-9);
  EXPECT_NEAR(flow.A(1, 1), -2.0 / 1.2, 1e-9);
  EXPECT_EQ(flow.inputs.back(), "servo/disturbance");
  EXPECT_NEAR(flow.B(1, flow.B.cols() - 1), 1.0 / 1.2, 1e-12);
}

// The derivatives of a sample: p + d/T of the error, and minus d/T of the last one.
TEST(LinearMotion, JumpsOfASample) {
  Case of(", sample_time: 0.1");
  ASSERT_TRUE(of.motion.linearize(of.start()).ok());
  const Eigen::MatrixXd after = of.motion.jump({{ControlEvent::Kind::kSample, 0, 5}});
  const ControllerStates& states = of.system.controllers()[0].states;
  EXPECT_NEAR(after(states.held, 0), -(20.0 + 2.0 / 0.1), 1e-12);
  EXPECT_NEAR(after(states.held, of.motion.motions() + states.last), -2.0 / 0.1, 1e-12);
  EXPECT_NEAR(after(states.last, 0), -1.0, 1e-14);
}

TEST(LinearMotion, AtRestControllersHaveSettled) {
  Case of(", sample_time: 0.1, delay: 0.15, time_constant: 0.3");
  ASSERT_TRUE(of.motion.linearize_at_rest(of.start()).ok());
  const double output = 20.0 * (0.2 - 0.3);
  const ControllerStates& states = of.system.controllers()[0].states;
  const VectorX<double>& s = of.motion.state().s;
  for (const int state : {states.held, states.queue, states.queue + 1, states.lag})
    EXPECT_NEAR(s[state], output, 1e-12);
  EXPECT_TRUE(of.motion.state().v.isZero(0.0));
}

}  // namespace
}  // namespace codesign
