// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_newton.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "equations/iteration_matrix.h"
#include "integration/servo.h"

namespace codesign {
namespace {

struct IdasNewtonTest : ::testing::Test {
  IdasNewtonTest()
      : system(servo("{}")),
        layout(system->layout()),
        context(make_context()),
        newton(*system, context.get()) {
    Equations<double> equations(*system);
    Assembly assembly(*system);
    equations.set_design(system->parameters());
    State<double> state;
    if (!assembly.solve(system->parameters(), &equations, &state).ok())
      throw std::logic_error("the start cannot be assembled");
    equations.linearize(state, newton.derivatives());
    size = 2 * layout.n + layout.states + layout.m;
    x = make_vector(size, context.get());
    b = make_vector(size, context.get());
    for (int k = 0; k < size; ++k) data(b)[k] = std::sin(3.0 * k);
  }

  static double* data(const VectorHandle& vector) { return N_VGetArrayPointer(vector.get()); }

  /// J x for the unknowns (q, v, s, lambda) whose derivatives are c_j times themselves; constraint
  /// rows stabilized, theory (27).
  VectorX<double> product(double c_j, double kappa) {
    State<double> direction;
    direction.resize(layout);
    const Eigen::Map<const VectorX<double>> all(data(x), size);
    direction.q = all.head(layout.n);
    direction.v = all.segment(layout.n, layout.n);
    direction.s = all.segment(Eigen::Index{2} * layout.n, layout.states);
    direction.z << c_j * direction.v, all.tail(layout.m), c_j * direction.s;
    VectorX<double> dG, result(size);
    directional_derivative(*system, *newton.derivatives(), direction, &dG);
    result << c_j * direction.q - direction.v, dG.head(layout.columns());
    direction.z.head(layout.n) += 2.0 * kappa * direction.v + kappa * kappa * direction.q;
    direction.v += kappa * direction.q;
    directional_derivative(*system, *newton.derivatives(), direction, &dG);
    result.segment(Eigen::Index{2} * layout.n, layout.m) = dG.segment(layout.n, layout.m);
    return result;
  }

  std::shared_ptr<const CompiledSystem> system;
  const Layout& layout;
  ContextHandle context;
  IdasNewton newton;
  int size;
  VectorHandle x, b;
};

TEST_F(IdasNewtonTest, SolvesTheWholeSystem) {
  for (double c_j : {10.0, 1e3, 1e6}) {
    newton.set_rates(c_j, 0.0);
    ASSERT_EQ(SUNLinSolSetup(newton.solver(), newton.matrix()), kSundialsSuccess);
    ASSERT_EQ(SUNLinSolSolve(newton.solver(), newton.matrix(), x.get(), b.get(), 0.0),
              kSundialsSuccess);
    EXPECT_LT((product(c_j, 0.0) - Eigen::Map<const VectorX<double>>(data(b), size))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9)
        << c_j;
  }
}

TEST_F(IdasNewtonTest, SolvesTheStabilizedSystem) {
  const double c_j = 1e3, kappa = 50.0;
  const Linearization<double> derivatives = *newton.derivatives();
  newton.set_rates(c_j, kappa);
  ASSERT_EQ(SUNLinSolSetup(newton.solver(), newton.matrix()), kSundialsSuccess);
  ASSERT_EQ(SUNLinSolSolve(newton.solver(), newton.matrix(), x.get(), b.get(), 0.0),
            kSundialsSuccess);
  *newton.derivatives() = derivatives;
  EXPECT_LT((product(c_j, kappa) - Eigen::Map<const VectorX<double>>(data(b), size))
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  // The terms matter.
  EXPECT_GT(
      (product(c_j, 0.0) - Eigen::Map<const VectorX<double>>(data(b), size)).cwiseAbs().maxCoeff(),
      1e-3);
}

TEST_F(IdasNewtonTest, RefactorsAtOtherDerivatives) {
  const Linearization<double> derivatives = *newton.derivatives();
  for (double& value : newton.derivatives()->rate) value *= 3.0;
  newton.set_rates(1e3, 50.0);
  ASSERT_EQ(SUNLinSolSetup(newton.solver(), newton.matrix()), kSundialsSuccess);
  ASSERT_TRUE(newton.refactor(derivatives));
  ASSERT_EQ(SUNLinSolSolve(newton.solver(), newton.matrix(), x.get(), b.get(), 0.0),
            kSundialsSuccess);
  *newton.derivatives() = derivatives;
  EXPECT_LT(
      (product(1e3, 50.0) - Eigen::Map<const VectorX<double>>(data(b), size)).cwiseAbs().maxCoeff(),
      1e-9);
}

TEST_F(IdasNewtonTest, ASingularMatrixIsARecoverableFailure) {
  newton.derivatives()->resize(system->patterns());
  for (std::vector<double>* values : {&newton.derivatives()->position,
                                      &newton.derivatives()->velocity, &newton.derivatives()->rate})
    std::fill(values->begin(), values->end(), 0.0);
  EXPECT_GT(SUNLinSolSetup(newton.solver(), newton.matrix()), 0);
  EXPECT_TRUE(newton.singular());
}

}  // namespace
}  // namespace codesign
