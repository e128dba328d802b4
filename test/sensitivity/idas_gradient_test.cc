// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "equations/equations.h"
#include "equations/formulas.h"
#include "integration/servo.h"
#include "sensitivity/idas_gradient.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

struct IdasTangentTest : ::testing::Test {
  IdasTangentTest()
      : system(servo("{integrator: idas}")),
        layout(system->layout()),
        integrator(*system),
        tangent(*system) {
    if (!integrator.start(system->parameters()).ok())
      throw std::logic_error("the start cannot be assembled");
    state = integrator.state();
    // Off the constraints, where stabilization shows.
    for (Eigen::Index k = 0; k < state.q.size(); ++k)
      state.q[k] += 1e-2 * std::sin(5.0 * static_cast<double>(k));
    direction.resize(layout);
    for (VectorX<double>* part : {&direction.q, &direction.v, &direction.s, &direction.z})
      for (Eigen::Index k = 0; k < part->size(); ++k)
        (*part)[k] = std::sin(3.0 * static_cast<double>(++count));
    starts.resize(5, state);
    scales.resize(5);
    tangent.start(system->parameters(), integrator.state(), &integrator, &starts, &scales);
  }

  /// (G + stabilization, g) differentiated along the direction and parameter k by a complex step.
  VectorX<double> reference(std::size_t k, double kappa) {
    const std::vector<double> parameters = system->parameters();
    std::vector<Complex> moved(parameters.begin(), parameters.end());
    moved[k] += Complex(0.0, 1e-30);
    Equations<Complex> equations(*system);
    equations.set_design(moved);
    State<Complex> at;
    at.turns = state.turns;
    const auto move = [](const VectorX<double>& from, const VectorX<double>& along) {
      return (from + Complex(0.0, 1e-30) * along).eval();
    };
    at.q = move(state.q, direction.q);
    at.v = move(state.v, direction.v);
    at.s = move(state.s, direction.s);
    at.z = move(state.z, direction.z);
    VectorX<Complex> G, Phi, Phi_rate;
    Complex g;
    equations.residual(at, &G, &g);
    equations.constraint_errors(at, &Phi, &Phi_rate);
    G.segment(layout.n, layout.m) += 2.0 * kappa * Phi_rate + kappa * kappa * Phi;
    VectorX<double> result(G.size() + 1);
    result << G.imag() / 1e-30, g.imag() / 1e-30;
    return result;
  }

  std::shared_ptr<const CompiledSystem> system;
  const Layout& layout;
  IdasIntegrator integrator;
  IdasTangent tangent;
  State<double> state, direction;
  std::vector<State<double>> starts;
  std::vector<double> scales;
  int count = 0;
};

TEST_F(IdasTangentTest, DerivativesMeetTheComplexStep) {
  ASSERT_EQ(tangent.count(), 5);
  for (double kappa : {0.0, 30.0}) {
    tangent.linearize(state, kappa, &integrator.equations());
    for (int k = 0; k < 5; ++k) {
      VectorX<double> result;
      const VectorX<double> expected = reference(static_cast<std::size_t>(k), kappa);
      tangent.derivative(k, direction, &result);
      EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff())
          << kappa << " " << k;
    }
  }
}

TEST_F(IdasTangentTest, StartsFromTheAssembliesSensitivities) {
  // The start angle is the fourth parameter; nothing else moves the start's positions.
  EXPECT_GT(starts[3].q.cwiseAbs().maxCoeff(), 0.1);
  for (std::size_t k : {0, 1, 2, 4}) EXPECT_EQ(starts[k].q.cwiseAbs().maxCoeff(), 0.0) << k;
  // The gains move accelerations at once.
  EXPECT_GT(starts[0].z.head(layout.n).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_EQ(scales, (std::vector<double>{40.0, 60.0, 3.0, 1.0, 0.5}));
}

TEST_F(IdasTangentTest, TerminalTermsUseConsistentRates) {
  // d/d rho_k of w along the start's own sensitivities, by central differences of assembled
  // designs.
  Eigen::VectorXd gradient;
  tangent.terminal(integrator.state(), &integrator.equations(), &starts, &gradient);
  for (std::size_t k = 0; k < 5; ++k) {
    double w[2];
    for (int side = 0; side < 2; ++side) {
      std::vector<double> parameters = system->parameters();
      parameters[k] += side ? 1e-5 : -1e-5;
      ASSERT_TRUE(integrator.start(parameters).ok());
      w[side] = integrator.equations().formulas().terminal(integrator.state());
    }
    EXPECT_NEAR(gradient[static_cast<Eigen::Index>(k)], (w[1] - w[0]) / 2e-5,
                1e-6 * (1.0 + std::abs(gradient[static_cast<Eigen::Index>(k)])))
        << k;
  }
}

TEST_F(IdasTangentTest, ProjectedDirectionsAreTangentToTheConstraints) {
  state = integrator.state();
  std::vector<State<double>> exact = starts, directions = starts;
  for (State<double>& moved : directions) {
    for (Eigen::Index k = 0; k < moved.q.size(); ++k)
      moved.q[k] += 1e-3 * std::sin(5.0 * static_cast<double>(k));
    for (Eigen::Index k = 0; k < moved.v.size(); ++k)
      moved.v[k] += 1e-3 * std::cos(5.0 * static_cast<double>(k));
  }
  const std::vector<State<double>> drifted = directions;
  ASSERT_TRUE(tangent.project(state, &integrator.equations(), &directions));
  VectorX<double> before, after;
  for (int k = 0; k < 5; ++k) {
    const auto at = static_cast<std::size_t>(k);
    // With kappa, the rows of constraints hold the derivatives of Phi and Phi_q v too.
    tangent.linearize(state, 3.0, &integrator.equations());
    tangent.derivative(k, drifted[at], &before);
    tangent.derivative(k, directions[at], &after);
    EXPECT_GT(before.segment(layout.n, layout.m).norm(), 1e-3) << k;
    EXPECT_LT(after.segment(layout.n, layout.m).norm(), 1e-9) << k;
    EXPECT_LT((directions[at].q - exact[at].q).norm(), 2.0 * (drifted[at].q - exact[at].q).norm())
        << k;
  }
  // Directions that are tangent to the constraints are not changed.
  directions = exact;
  ASSERT_TRUE(tangent.project(state, &integrator.equations(), &directions));
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_LT((directions[k].v - exact[k].v).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace

}  // namespace codesign
