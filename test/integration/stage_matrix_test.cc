// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/servo.h"
#include "integration/stage_matrix.h"
#include "math/dense.h"
#include "sparse/sparsity.h"

namespace codesign {
namespace {

/// The product by machine code, where it is available, and by loops.
class StageProductTest : public ::testing::TestWithParam<bool> {
 protected:
  StageProductTest() {
    derivatives.resize(system->patterns());
    int k = 0;
    for (std::vector<double>* values : {&derivatives.position, &derivatives.velocity})
      for (double& value : *values) value = std::sin(++k);
  }

  template <int N>
  void compare() {
    const StageProduct product(*system, GetParam());
    const Layout& layout = system->layout();
    const Eigen::Matrix<double, N, Eigen::Dynamic> xv =
        Eigen::Matrix<double, N, Eigen::Dynamic>::Random(N, layout.positions() + layout.n);
    Eigen::Matrix<double, N, Eigen::Dynamic> y = Eigen::Matrix<double, N, Eigen::Dynamic>::Random(
                                                 N, layout.columns()),
                                             expected = y;
    for (int lane = 0; lane < N; ++lane) {
      const VectorX<double> x = xv.row(lane).head(layout.positions()),
                            v = xv.row(lane).tail(layout.n);
      for (int row = 0; row < layout.columns(); ++row)
        expected(lane, row) -=
            row_product(system->patterns().position, derivatives.position, row, x) +
            row_product(system->patterns().velocity, derivatives.velocity, row, v);
    }
    product.subtract<N>(derivatives, xv, y);
    EXPECT_LT((y - expected).cwiseAbs().maxCoeff(), 1e-13);
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  Linearization<double> derivatives;
};

TEST_P(StageProductTest, IsThatOfBothMatricesForOneAndForSeveralVectors) {
  ASSERT_GT(system->layout().states, 0);
  compare<1>();
  compare<4>();
  compare<8>();
}

INSTANTIATE_TEST_SUITE_P(MachineCodeAndLoops, StageProductTest, ::testing::Bool());

TEST(Projection, TakesDriftAwayAndMovesByNoMore) {
  const auto system = compile(
      double_pendulum(),
      motion_study(1.0, "{shoulder: {position: 0.7, velocity: 2.0}}", "elbow/velocity", "{}"));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({}).ok());
  Projection projection(*system);
  State<double> state = integrator.state();
  const State<double> exact = state;
  for (Eigen::Index k = 0; k < state.q.size(); ++k) {
    state.q[k] += 1e-3 * std::sin(3.0 * static_cast<double>(k));
    state.v[k] += 1e-3 * std::cos(5.0 * static_cast<double>(k));
  }
  const State<double> drifted = state;
  ASSERT_TRUE(projection.apply(&integrator.equations(), &state));
  VectorX<double> Phi, Phi_rate;
  integrator.equations().constraint_errors(state, &Phi, &Phi_rate);
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(Phi_rate.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((state.q - exact.q).norm(), 2.0 * (drifted.q - exact.q).norm());
}

TEST(Projection, LeavesAConsistentStateAlone) {
  const auto system = compile(
      double_pendulum(),
      motion_study(1.0, "{shoulder: {position: 0.7, velocity: 2.0}}", "elbow/velocity", "{}"));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({}).ok());
  State<double> state = integrator.state();
  ASSERT_TRUE(Projection(*system).apply(&integrator.equations(), &state));
  EXPECT_LT((state.q - integrator.state().q).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((state.v - integrator.state().v).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace

}  // namespace codesign
