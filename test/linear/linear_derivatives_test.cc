// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_derivatives.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/equilibrium.h"
#include "math/differences.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

/// A linearization about rest with its derivatives.
struct RestCase {
  explicit RestCase(const Problem& of)
      : problem(of), derivatives({system_of(problem).get(), problem.parameters(), {}, true, {}}) {
    const Equilibrium rest = rest_at(problem.parameters());
    EXPECT_TRUE(derivatives.take(problem.parameters(), rest.state, rest.integrals).ok());
  }

  Equilibrium rest_at(const std::vector<double>& parameters) const {
    LinearQuestion question;
    const Equilibrium rest =
        find_equilibrium(*system_of(problem), parameters, {}, nullptr, question);
    EXPECT_TRUE(rest.status.ok()) << rest.status.cause;
    return rest;
  }
  Eigen::MatrixXd change(std::size_t direction) {
    return derivatives.closed(direction).A.imag() / LinearDerivatives::kStep;
  }

  Problem problem;
  LinearDerivatives derivatives;
};

std::string one_tuned(const std::string& name, double value) {
  return "  " + name + ": {initial: " + std::to_string(value) + ", lower: 0.001, upper: 1000}\n";
}

// A = [0 1; -p -d]; from an effort beside the output to it: C = [-p -d], with the sign of H.
TEST(LinearDerivatives, OfACart) {
  RestCase of(
      loaded(carts(1, {""}), "parameters:\n" + one_tuned("p", 4.0) + one_tuned("d", 1.0) +
                                 controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}"))));
  ASSERT_EQ(of.derivatives.directions(), 2U);
  Eigen::Matrix2d by_p, by_d;
  by_p << 0.0, 0.0, -1.0, 0.0;
  by_d << 0.0, 0.0, 0.0, -1.0;
  EXPECT_LT((of.change(0) - by_p).norm(), 1e-14);
  EXPECT_LT((of.change(1) - by_d).norm(), 1e-14);
  const ComplexSpace loop = of.derivatives.loop(0, 0);
  EXPECT_LT((loop.B.real() - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-14);
  EXPECT_LT((loop.C.real() - Eigen::RowVector2d(-4.0, -1.0)).norm(), 1e-14);
  EXPECT_LT((loop.C.imag() / LinearDerivatives::kStep - Eigen::RowVector2d(-1.0, 0.0)).norm(),
            1e-14);
}

// Continuous and sampled, about a posture that moves: as differences of the linearization.
TEST(LinearDerivatives, ThroughAPostureThatMoves) {
  const std::string urdf =
      R"(<robot name="arm"><link name="base"/><link name="bar"><inertial><origin xyz="0 0 -0.5"/>
<mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
<dynamics damping="0.1"/></joint></robot>)";
  for (const std::string realization :
       {", time_constant: 0.05, derivative_filter: 0.03",
        ", sample_time: 0.01, delay: 0.004, filter: {type: low_pass, frequency: 30}"}) {
    RestCase of(
        loaded(urdf, "parameters:\n" + one_tuned("p", 30.0) + one_tuned("top", 1.0) +
                         "duration: 10\ncontrollers: {servo: {type: pid, input: hinge/position, "
                         "setpoint: \"${top}\", output: hinge, gains: {p: \"${p}\", d: 2}" +
                         realization + "}}\n"));
    const std::vector<double> parameters = of.problem.parameters();
    for (std::size_t direction = 0; direction < 2; ++direction) {
      const Eigen::MatrixXd exact = of.change(direction);
      EXPECT_LT((of.derivatives.closed(direction).A.real() - of.rest_at(parameters).linear.system.A)
                    .norm(),
                1e-11 * exact.norm() + 1e-11);
      for (Eigen::Index row = 0; row < exact.rows(); ++row)
        for (Eigen::Index column = 0; column < exact.cols(); ++column) {
          const auto value = [&](double step) {
            std::vector<double> moved = parameters;
            moved[direction] += step;
            return of.rest_at(moved).linear.system.A(row, column);
          };
          const RiddersDerivative reference =
              ridders_derivative(value, 0.0, 1e-2 * parameters[direction]);
          EXPECT_NEAR(exact(row, column), reference.value,
                      1e-7 * exact.cwiseAbs().maxCoeff() + 10.0 * reference.error)
              << realization << row << column;
        }
    }
  }
}

// A sample reads an acceleration through a continuous controller.
TEST(LinearDerivatives, OfASampleThatReadsAnAcceleration) {
  RestCase of(loaded(
      carts(2, {damped(1.0), sprung(3.0, 0.5)}, true),
      "parameters:\n" + one_tuned("p", 30.0) +
          controlled("servo: {type: pid, input: \"${x0/position + 0.1*x0/velocity + "
                     "0.01*x0/acceleration}\", setpoint: 0, output: x0, gains: {p: \"${p}\"}}, "
                     "follow: {type: pid, input: servo/output, setpoint: 0, output: x1, gains: {p: "
                     "0.1}, sample_time: 0.1}")));
  const Eigen::MatrixXd exact = of.change(0);
  for (Eigen::Index row = 0; row < exact.rows(); ++row)
    for (Eigen::Index column = 0; column < exact.cols(); ++column) {
      const RiddersDerivative reference = ridders_derivative(
          [&](double step) { return of.rest_at({30.0 + step}).linear.system.A(row, column); }, 0.0,
          0.5);
      EXPECT_NEAR(exact(row, column), reference.value,
                  1e-7 * exact.cwiseAbs().maxCoeff() + 10.0 * reference.error)
          << row << column;
    }
}

// Where a cart stands that only a speed loop holds.
TEST(LinearDerivatives, NamesTheDirectionsThatNothingDetermines) {
  RestCase of(
      loaded(carts(1, {""}), "parameters:\n" + one_tuned("p", 4.0) +
                                 controlled(cart_servo("gains: {p: \"${p}\"}", "0", "velocity"))));
  EXPECT_EQ(of.derivatives.parameters(), 1U);
  EXPECT_EQ(of.derivatives.directions(), 2U);
  EXPECT_LT(of.change(1).norm(), 1e-12);
}

}  // namespace
}  // namespace codesign
