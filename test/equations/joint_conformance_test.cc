// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The same tests for every kind of joint, in the tree and as a loop, and for couplings.
#include <gtest/gtest.h>

#include <complex>

#include "assembly/redundancy.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"
#include "equations/joint_cases.h"
#include "math/dense.h"
#include "math/differences.h"

namespace codesign {
namespace {

using C = std::complex<double>;

class JointConformance : public ::testing::TestWithParam<JointCase> {
 protected:
  JointConformance()
      : c(joint_cases::model(GetParam()),
          "duration: 1.0\nobjective: {integral: [{signal: tip/position/x}]}\n"),
        complex(c.system) {
    const std::vector<double> parameters = c.system.parameters();
    complex.set_design(std::vector<C>(parameters.begin(), parameters.end()));
  }

  void SetUp() override {
    ASSERT_TRUE(c.start().ok());
    ASSERT_TRUE(scramble(&c));
    Phi_q = constraint_jacobian(c.system, &c.equations, c.state);
  }

  const Layout& layout() const { return c.system.layout(); }
  Eigen::VectorXd accelerations() const { return c.state.z.head(layout().n); }

  /// Phi_q by the complex step.
  Eigen::MatrixXd position_jacobian() {
    return complex_step_jacobian(
        [&](const Eigen::VectorXcd& q) {
          VectorX<C> Phi, Phi_rate;
          State<C> state;
          cast_state(c.state, &state);
          state.q = q;
          complex.constraint_errors(state, &Phi, &Phi_rate);
          return Eigen::VectorXcd(Phi);
        },
        c.state.q);
  }

  Compiled c;
  Equations<C> complex;
  Eigen::MatrixXd Phi_q;
};

TEST_P(JointConformance, RowsAreAsManyAsTheJointTakesFreedoms) {
  EXPECT_EQ(layout().m, GetParam().rows + layout().bodies);
  EXPECT_EQ(pivot_columns(Phi_q, 1e-9).rank, layout().m);
  EXPECT_TRUE(analyse_redundancy(c.system, &c.equations, c.assembly, c.system.parameters(), c.state)
                  .rows.empty());
}

TEST_P(JointConformance, PhiQIsTheJacobianOfPhi) {
  const Eigen::MatrixXd reference = position_jacobian();
  const int own = layout().coupling_row(0);
  EXPECT_LT(compare_jacobians(Phi_q.topRows(own), reference.topRows(own)).largest, 1e-12);
  EXPECT_LT(
      compare_jacobians(Phi_q.bottomRows(layout().bodies), reference.bottomRows(layout().bodies))
          .largest,
      1e-12);
  // The rate of a turn comes from angular velocities; it is the derivative of the arc tangent only
  // along motions that the joint allows.
  Eigen::MatrixXd rigid(own + layout().bodies, layout().n);
  rigid << Phi_q.topRows(own), Phi_q.bottomRows(layout().bodies);
  const Eigen::MatrixXd motions = orthogonal_complement(rigid.transpose(), 1e-9);
  const int couplings = layout().couplings;
  EXPECT_LT(compare_jacobians(Phi_q.middleRows(own, couplings) * motions,
                              reference.middleRows(own, couplings) * motions)
                .largest,
            1e-11);
}

TEST_P(JointConformance, AccelerationRowsAreTheSecondDerivativeOfPhi) {
  constexpr double h = 1e-30;
  VectorX<C> Phi, rates;
  State<C> moved;
  cast_state(c.state, &moved);
  moved.q += C(0.0, h) * c.state.v.cast<C>();
  moved.v += C(0.0, h) * accelerations().cast<C>();
  complex.constraint_errors(moved, &Phi, &rates);
  Eigen::VectorXd G, errors, real_rates;
  double g = 0.0;
  c.equations.residual(c.state, &G, &g);
  c.equations.constraint_errors(c.state, &errors, &real_rates);
  EXPECT_LT((Phi.imag() / h - real_rates).norm(), 1e-12);
  EXPECT_LT((rates.imag() / h - G.segment(layout().n, layout().m)).norm(), 1e-11);
  // At a = 0 they are (Phi_q v)_q v.
  State<double> coasting = c.state;
  coasting.z.head(layout().n).setZero();
  c.equations.residual(coasting, &G, &g);
  EXPECT_LT((G.segment(layout().n, layout().m) + Phi_q * accelerations()).norm(), 1e-11);
}

TEST_P(JointConformance, ParameterDerivativesOfLanesAreThoseOfTheComplexStep) {
  const std::vector<double> parameters = c.system.parameters();
  ASSERT_EQ(parameters.size(), 3U);
  Equations<Lanes<4>> lanes(c.system);
  std::vector<Lanes<4>> seeded(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < seeded.size(); ++k) seeded[k].v[static_cast<int>(k)] = 1.0;
  lanes.set_design(seeded);
  const auto rows = [this](auto* equations, const auto& zero) {
    using T = std::decay_t<decltype(zero)>;
    State<T> state;
    cast_state(c.state, &state);
    VectorX<T> G, Phi, Phi_rate;
    T g(0.0);
    equations->residual(state, &G, &g);
    equations->constraint_errors(state, &Phi, &Phi_rate);
    VectorX<T> all(G.size() + 2 * Phi.size());
    all << G, Phi, Phi_rate;
    return all;
  };
  const VectorX<Lanes<4>> by_lanes = rows(&lanes, Lanes<4>(0.0));
  Eigen::MatrixXd derivative(by_lanes.size(), 3);
  for (Eigen::Index row = 0; row < derivative.rows(); ++row)
    for (int k = 0; k < 3; ++k) derivative(row, k) = by_lanes[row].v[k];
  const Eigen::MatrixXd reference = complex_step_jacobian(
      [&](const Eigen::VectorXcd& x) {
        complex.set_design(std::vector<C>(x.data(), x.data() + x.size()));
        return Eigen::VectorXcd(rows(&complex, C(0.0)));
      },
      Eigen::Map<const Eigen::VectorXd>(parameters.data(), 3));
  EXPECT_LT(compare_jacobians(derivative, reference).largest, 1e-11);
  if (!GetParam().loaded) return;
  EXPECT_GT(derivative.col(0).norm(), 1e-3) << "the joint's place counts";
  EXPECT_GT(derivative.col(1).norm(), 1e-3) << "and so does the mass";
}

/// Force on a body in ground axes and torque about its centre in body axes.
struct Wrench {
  Eigen::Vector3d force, torque;
};

/// The wrench that must act on a body besides its weight, by Newton-Euler from its acceleration.
Wrench demanded(const Compiled& c, int b) {
  const BodyConstants<double>& constants =
      c.equations.constants().bodies[static_cast<std::size_t>(b)];
  const Eigen::Vector3d gravity(c.system.study().gravity.data());
  const Eigen::Vector4d p = c.state.q.segment<4>(kBodySize * b + 3),
                        pd = c.state.v.segment<4>(kBodySize * b + 3),
                        pdd = c.state.z.segment<4>(kBodySize * b + 3);
  const Eigen::Vector3d omega = 2.0 * (body_rate_matrix(p) * pd),
                        alpha = 2.0 * (body_rate_matrix(p) * pdd);
  return {constants.mass * (c.state.z.segment<3>(kBodySize * b) - gravity),
          constants.J * alpha + omega.cross(constants.J * omega)};
}

/// The wrench of the multipliers on it, by virtual work with p' = G^T omega/2.
Wrench exerted(const Compiled& c, const Eigen::MatrixXd& Phi_q, int b) {
  const Layout& layout = c.system.layout();
  const Eigen::VectorXd load = -Phi_q.transpose() * c.state.z.segment(layout.n, layout.m);
  const Eigen::Vector4d p = c.state.q.segment<4>(kBodySize * b + 3);
  return {load.segment<3>(kBodySize * b),
          0.5 * (body_rate_matrix(p) * load.segment<4>(kBodySize * b + 3))};
}

TEST_P(JointConformance, ReactionsBalanceEachBody) {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (int b = 0; b < layout().bodies; ++b) {
    const Wrench need = demanded(c, b), have = exerted(c, Phi_q, b);
    EXPECT_LT((need.force - have.force).norm(), 1e-10 * (1.0 + need.force.norm()));
    EXPECT_LT((need.torque - have.torque).norm(), 1e-10 * (1.0 + need.torque.norm()));
    const Eigen::Matrix3d A = rotation<double>(c.state.q.segment<4>(kBodySize * b + 3));
    force += have.force;
    moment += c.state.q.segment<3>(kBodySize * b).cross(have.force) + A * have.torque;
  }
  // The bodies fly freely except for the joint, so that its actions and reactions cancel.
  EXPECT_LT(force.norm(), 1e-10);
  EXPECT_LT(moment.norm(), 1e-10);
}

TEST_P(JointConformance, TheReactionInTheJointsAxesIsWhatTheTipFeels) {
  if (!GetParam().reaction || GetParam().rows > 6) GTEST_SKIP() << "not a joint with F'' and T''";
  for (std::size_t k = 0; k < c.system.topology().pairs.size(); ++k) {
    const Pair& pair = c.system.topology().pairs[k];
    if (pair.kind == PairKind::kFree) continue;
    c.equations.formulas().load(c.state);
    Eigen::Vector3d F, T;
    c.equations.formulas().reaction(static_cast<int>(k), &F, &T);
    const PairConstants<double>& geometry = c.equations.constants().pairs[k];
    const Eigen::Matrix3d A_j = c.equations.formulas().body(pair.body_j).A,
                          axes = c.equations.formulas().body(pair.body_i).A * geometry.C_i;
    const Eigen::Vector3d force = -axes * F,
                          torque = A_j.transpose() * ((A_j * geometry.s_j).cross(force) - axes * T);
    const Wrench need = demanded(c, pair.body_j);
    EXPECT_LT((force - need.force).norm(), 1e-10 * (1.0 + need.force.norm()));
    EXPECT_LT((torque - need.torque).norm(), 1e-10 * (1.0 + need.torque.norm()));
  }
}

INSTANTIATE_TEST_SUITE_P(AllJoints, JointConformance, ::testing::ValuesIn(joint_cases::all()),
                         [](const auto& instance) { return instance.param.name; });

TEST(FixedJoint, MakesOneBodyOfTwoLinks) {
  Compiled c(
      joint_cases::model(
          {"fixed",
           joint_cases::tree("joint", "fixed", "base", "tip", "1 0 0", joint_cases::kOrigin), 0}),
      "duration: 1.0\nobjective: {integral: [{signal: tip/position/x}]}\n");
  EXPECT_EQ(c.system.layout().bodies, 1);
  EXPECT_EQ(c.system.layout().m, 1);
  c.equations.set_design(c.system.parameters());
  EXPECT_NEAR(c.equations.constants().bodies[0].mass, 1.6, 1e-15);
}

}  // namespace
}  // namespace codesign
