// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "integration/servo.h"
#include "sparse/sparsity.h"

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

using Complex = std::complex<double>;

struct DerivativeProducts : ::testing::Test {
  DerivativeProducts() : system(servo("{}")), equations(*system) {
    equations.set_design(system->parameters());
    for (State<double>* s : {&state, &direction}) {
      s->resize(system->layout());
      for (VectorX<double>* part : {&s->q, &s->v, &s->s, &s->z})
        for (Eigen::Index k = 0; k < part->size(); ++k)
          (*part)[k] = std::sin(3.0 * static_cast<double>(++count));
    }
    derivatives.resize(system->patterns());
    equations.linearize(state, &derivatives);
  }

  /// (G, g) differentiated along `direction` by a complex step.
  VectorX<double> reference() const {
    const std::vector<double> parameters = system->parameters();
    Equations<Complex> complex(*system);
    complex.set_design({parameters.begin(), parameters.end()});
    State<Complex> moved;
    cast_state(state, &moved);
    const auto move = [](const VectorX<double>& from, const VectorX<double>& along) {
      return (from + Complex(0.0, 1e-30) * along).eval();
    };
    moved.q = move(state.q, direction.q);
    moved.v = move(state.v, direction.v);
    moved.s = move(state.s, direction.s);
    moved.z = move(state.z, direction.z);
    VectorX<Complex> G;
    Complex g;
    complex.residual(moved, &G, &g);
    VectorX<double> result(G.size() + 1);
    result << G.imag() / 1e-30, g.imag() / 1e-30;
    return result;
  }

  std::shared_ptr<const CompiledSystem> system;
  Equations<double> equations;
  State<double> state, direction;
  Linearization<double> derivatives;
  int count = 0;
};

TEST_F(DerivativeProducts, DirectionalDerivativeMeetsTheComplexStep) {
  VectorX<double> result;
  directional_derivative(*system, derivatives, direction, &result);
  EXPECT_LT((result - reference()).cwiseAbs().maxCoeff(),
            1e-11 * (1.0 + result.cwiseAbs().maxCoeff()));
}

TEST_F(DerivativeProducts, ThePositionProductIsThatOfPositionsAlone) {
  direction.v.setZero();
  direction.s.setZero();
  direction.z.setZero();
  const int columns = system->layout().columns();
  VectorX<double> result = VectorX<double>::Ones(columns);
  subtract_position_product(*system, derivatives, direction.q, 2.0, result);
  const VectorX<double> expected = VectorX<double>::Ones(columns) - 2.0 * reference().head(columns);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(),
            1e-11 * (1.0 + expected.cwiseAbs().maxCoeff()));
}

}  // namespace

}  // namespace codesign
