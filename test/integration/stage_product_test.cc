// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stage_product.h"

#include <gtest/gtest.h>

#include "integration/servo.h"
#include "sparse/row_product.h"

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
    const Eigen::Matrix<double, N, Eigen::Dynamic> xv = Eigen::Matrix<double, N, Eigen::Dynamic>::Random(N, layout.positions() + layout.n);
    Eigen::Matrix<double, N, Eigen::Dynamic> y = Eigen::Matrix<double, N, Eigen::Dynamic>::Random(N, layout.columns()), expected = y;
    for (int lane = 0; lane < N; ++lane) {
      const VectorX<double> x = xv.row(lane).head(layout.positions()), v = xv.row(lane).tail(layout.n);
      for (int row = 0; row < layout.columns(); ++row)
        expected(lane, row) -= row_product(system->patterns().position, derivatives.position, row, x) +
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

}  // namespace
}  // namespace codesign
