// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "equations/generic_state.h"
#include "integration/servo.h"
#include "math/scalar.h"
#include "sensitivity/tangent_step.h"

namespace codesign {
namespace {

/// Compares results with and without machine code with the results of Equations<Lanes>.
class TangentEquationsTest : public ::testing::TestWithParam<bool> {
 protected:
  TangentEquationsTest() {
    const std::vector<double> values = system->parameters();
    std::vector<Lanes<4>> parameters(values.begin(), values.end());
    for (int k = 0; k < 4; ++k) parameters[static_cast<std::size_t>(k)].v[k] = 1.0;
    tangents.equations().set_design(parameters);
    tangents.equations().compiled().allow(GetParam());
    equations.set_design(parameters);
    equations.compiled().allow(false);
    state.resize(system->layout());
    state.t = 0.2;
    state.q = waves(state.q.size(), 0.3), state.v = waves(state.v.size(), 1.1);
    state.s = waves(state.s.size(), 2.0), state.z = waves(state.z.size(), 0.7);
    for (Eigen::Index k = 0; k < y.size(); ++k)
      y.data()[k] = std::sin(0.7 * static_cast<double>(k));
  }

  static void expect_equal(const Eigen::Ref<const Eigen::Matrix<double, 4, Eigen::Dynamic>>& actual,
                           const VectorX<Lanes<4>>& expected) {
    ASSERT_GE(actual.cols(), expected.size());
    for (Eigen::Index k = 0; k < expected.size(); ++k)
      EXPECT_LT((actual.col(k) - expected[k].directions()).norm(),
                1e-11 * (1.0 + expected[k].directions().norm()))
          << k;
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  TangentEquations<4> tangents{*system};
  Equations<Lanes<4>> equations{*system};
  State<double> state;
  Directions<4> y{IncrementLayout(system->layout()).size()};
};

TEST_P(TangentEquationsTest, OfTheResidualHaveTheIntegrandLast) {
  Directions<4> actual;
  tangents.residual(state, y, &actual);
  VectorX<Lanes<4>> G;
  Lanes<4> g;
  equations.residual(tangents.lanes(state, y), &G, &g);
  expect_equal(actual, G);
  EXPECT_LT((actual.rightCols(1) - g.directions()).norm(), 1e-11 * (1.0 + g.directions().norm()));
}

TEST_P(TangentEquationsTest, OfTheMatricesAreOnTheirPatterns) {
  tangents.linearize(state, y);
  Linearization<Lanes<4>> expected;
  expected.resize(system->patterns());
  equations.linearize(tangents.lanes(state, y), &expected);
  const auto compare = [](const LineVector& actual, const std::vector<Lanes<4>>& lanes) {
    ASSERT_EQ(actual.size(), 4 * lanes.size());
    expect_equal(
        Eigen::Map<const Eigen::Matrix<double, 4, Eigen::Dynamic>>(
            actual.data(), 4, static_cast<Eigen::Index>(lanes.size())),
        Eigen::Map<const VectorX<Lanes<4>>>(lanes.data(), static_cast<Eigen::Index>(lanes.size())));
  };
  compare(tangents.changes().position, expected.position);
  compare(tangents.changes().velocity, expected.velocity);
  compare(tangents.changes().rate, expected.rate);
  expect_equal(tangents.time_changes(), expected.time);
}

TEST_P(TangentEquationsTest, OfTheConstraintsAreOnePerRow) {
  Directions<4> Phi, Phi_rate;
  tangents.constraint_errors(state, y, &Phi, &Phi_rate);
  VectorX<Lanes<4>> expected, expected_rate;
  const State<Lanes<4>>& both = tangents.lanes(state, y);
  equations.constraint_errors(both, &expected, &expected_rate);
  expect_equal(Phi, expected);
  expect_equal(Phi_rate, expected_rate);
}

/// A joint in its stop needs another variant of the recorded equations.
TEST(TangentEquations, FollowTheBranchOfTheState) {
  const std::string narrow = "<limit lower='-0.05' upper='0.04' effort='2' velocity='1'/>";
  const std::shared_ptr<const CompiledSystem> system =
      compile(robot(bar("arm") +
                    "<joint name='hinge' type='revolute'><parent link='ground'/><child "
                    "link='arm'/><axis xyz='0 1 0'/>" +
                    narrow + "</joint>"),
              motion_study(1.0, "{}", "hinge/velocity", "{}") +
                  "limits: {position: true, stiffness: 20.0, width: 0.01}\n");
  TangentEquations<4> tangents(*system);
  tangents.equations().set_design({});
  State<double> state;
  state.resize(system->layout());
  state.q[3] = std::cos(0.05), state.q[5] = std::sin(0.05);
  Directions<4> y(IncrementLayout(system->layout()).size()), actual;
  for (Eigen::Index k = 0; k < y.size(); ++k) y.data()[k] = std::sin(0.7 * static_cast<double>(k));
  tangents.residual(state, y, &actual);
  VectorX<Lanes<4>> G;
  Lanes<4> g;
  tangents.equations().residual(tangents.lanes(state, y), &G, &g);
  for (Eigen::Index k = 0; k < G.size(); ++k)
    EXPECT_LT((actual.col(k) - G[k].directions()).norm(), 1e-12 * (1.0 + G[k].directions().norm()));
}

INSTANTIATE_TEST_SUITE_P(Code, TangentEquationsTest, ::testing::Values(true, false),
                         [](const auto& code) {
                           return code.param ? std::string("compiled") : std::string("interpreted");
                         });

using C = std::complex<double>;
constexpr double kSize = 2e-3;
constexpr int kSteps = 5;

/// A few steps of the servo, their tangent by lanes, and the same steps with one parameter moved
/// along the imaginary axis.
class TangentStepTest : public ::testing::Test {
 protected:
  TangentStepTest() : step(*system, rodas4()), tangent(*system, rodas4()), assembly(*system) {
    const std::vector<double> parameters = system->parameters();
    step.equations().set_design(parameters);
    EXPECT_TRUE(assembly.solve(parameters, &step.equations(), &initial).ok());
    step.start(initial);
    std::vector<Lanes<4>> lanes(parameters.begin(), parameters.end());
    for (std::size_t k = 0; k < 4; ++k) lanes[k].v[static_cast<int>(k)] = 1.0;
    tangent.start(lanes, assembly, initial);
  }

  void advance() {
    for (int k = 0; k < kSteps; ++k) {
      ASSERT_TRUE(step.attempt(kSize));
      tangent.attempt(&step);
      ASSERT_TRUE(step.accept());
      tangent.accept(step);
    }
  }

  std::unique_ptr<OneStep<C>> shifted(std::size_t parameter, double h) {
    std::vector<C> parameters;
    for (double p : system->parameters()) parameters.emplace_back(p);
    parameters[parameter] += C(0.0, h);
    auto run = std::make_unique<OneStep<C>>(*system, rodas4());
    run->equations().set_design(parameters);
    State<C> start;
    assembly.extend(parameters, initial, &run->equations(), &start);
    run->start(start);
    for (int k = 0; k < kSteps; ++k) EXPECT_TRUE(run->attempt(kSize) && run->accept());
    return run;
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  OneStep<double> step;
  TangentStep<4> tangent;
  Assembly assembly;
  State<double> initial;
};

TEST_F(TangentStepTest, IsTheDerivativeOfTheStepsToRounding) {
  advance();
  const IncrementLayout& at = step.increment_layout();
  constexpr double h = 1e-30;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto run = shifted(k, h);
    const auto row = static_cast<Eigen::Index>(k);
    const auto compare = [&](const VectorX<C>& value, int first) {
      const Eigen::VectorXd
          expected = value.imag() / h,
          actual = tangent.directions().row(row).segment(first, value.size()).transpose();
      EXPECT_LT((actual - expected).norm(), 1e-11 * (1.0 + expected.norm())) << "parameter " << k;
    };
    compare(run->state().q, at.x());
    compare(run->state().s, at.s());
    compare(run->state().v, at.v());
    compare(run->state().z, at.z());
    EXPECT_NEAR(tangent.psi()[row], run->psi().imag() / h,
                1e-12 * (1.0 + std::abs(run->psi().imag() / h)));
  }
}

TEST_F(TangentStepTest, ErrorFallsWithTheStep) {
  ASSERT_TRUE(step.attempt(kSize));
  tangent.attempt(&step);
  const double coarse = tangent.error(step, 1e-6);
  EXPECT_GT(coarse, 0.0);
  EXPECT_NEAR(tangent.error(step, 1e-5), 0.1 * coarse, 1e-12 * coarse);
  ASSERT_TRUE(step.attempt(0.25 * kSize));
  tangent.attempt(&step);
  EXPECT_LT(tangent.error(step, 1e-6), 0.1 * coarse);
}

}  // namespace

}  // namespace codesign
