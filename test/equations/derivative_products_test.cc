// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/derivative_products.h"

#include <gtest/gtest.h>

#include "equations/equations.h"
#include "integration/servo.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

struct DerivativeProducts : ::testing::Test {
  DerivativeProducts() : system(servo("{}")), equations(*system) {
    equations.set_design(system->parameters());
    for (State<double>* s : {&state, &direction}) {
      s->resize(system->layout());
      for (VectorX<double>* part : {&s->q, &s->v, &s->s, &s->z})
        for (Eigen::Index k = 0; k < part->size(); ++k) (*part)[k] = std::sin(3.0 * static_cast<double>(++count));
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
    const auto move = [](const VectorX<double>& from, const VectorX<double>& along) { return (from + Complex(0.0, 1e-30) * along).eval(); };
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
  EXPECT_LT((result - reference()).cwiseAbs().maxCoeff(), 1e-11 * (1.0 + result.cwiseAbs().maxCoeff()));
}

TEST_F(DerivativeProducts, ThePositionProductIsThatOfPositionsAlone) {
  direction.v.setZero();
  direction.s.setZero();
  direction.z.setZero();
  const int columns = system->layout().columns();
  VectorX<double> result = VectorX<double>::Ones(columns);
  subtract_position_product(*system, derivatives, direction.q, 2.0, result);
  const VectorX<double> expected = VectorX<double>::Ones(columns) - 2.0 * reference().head(columns);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-11 * (1.0 + expected.cwiseAbs().maxCoeff()));
}

}  // namespace
}  // namespace codesign
