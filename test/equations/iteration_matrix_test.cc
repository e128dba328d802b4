// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/iteration_matrix.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "integration/servo.h"
#include "sparse/row_product.h"

namespace codesign {
namespace {

/// By machine code, where there is any, and by loops.
class IterationMatrixTest : public ::testing::TestWithParam<bool> {};

TEST_P(IterationMatrixTest, SolvesItsCombinationOfTheThreeMatrices) {
  const auto system = servo("{integrator: rosenbrock}");
  const Layout& layout = system->layout();
  ASSERT_EQ(layout.states, 1);
  Equations<double> equations(*system);
  equations.set_design(system->parameters());
  Assembly assembly(*system);
  State<double> state;
  ASSERT_TRUE(assembly.solve(system->parameters(), &equations, &state).ok());
  Linearization<double> d;
  d.resize(system->patterns());
  equations.linearize(state, &d);

  IterationMatrix matrix(*system, GetParam());
  const double c_v = 0.1, c_q = 0.02, c_s = 0.3;
  ASSERT_TRUE(matrix.factor(d, c_v, c_q, c_s));
  const VectorX<double> b = VectorX<double>::LinSpaced(layout.columns(), -1.0, 1.0);
  VectorX<double> z = b;
  matrix.lu().solve(z);
  VectorX<double> x(layout.positions());
  x << c_q * z.head(layout.n), c_s * z.tail(layout.states);
  const VectorX<double> v = c_v * z.head(layout.n);
  for (int row = 0; row < layout.columns(); ++row) {
    const double product = row_product(system->patterns().rate, d.rate, row, z) +
                           row_product(system->patterns().velocity, d.velocity, row, v) +
                           row_product(system->patterns().position, d.position, row, x);
    EXPECT_NEAR(product, b[row], 1e-9) << row;
  }
}

INSTANTIATE_TEST_SUITE_P(MachineCodeAndLoops, IterationMatrixTest, ::testing::Bool());

}  // namespace
}  // namespace codesign
