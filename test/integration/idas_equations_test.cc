// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_equations.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "assembly/assembly.h"
#include "integration/servo.h"

namespace codesign {
namespace {

/// Sensitivities that throw, to test the handling of exceptions in callbacks.
struct Faulty : IdasSensitivities {
  int count() const override { return 1; }
  void start(const std::vector<double>&, const State<double>&, Integrator*,
             std::vector<State<double>>*, std::vector<double>*) override {}
  const Linearization<double>& linearize(const State<double>&, double,
                                         Equations<double>*) override {
    throw std::runtime_error("no derivatives today");
  }
  void derivative(int, const State<double>&, VectorX<double>*) override {}
  bool jump(const std::vector<ControlEvent>&, const State<double>&, const State<double>&,
            Equations<double>*, std::vector<State<double>>*) override {
    return false;
  }
  bool project(const State<double>&, Equations<double>*, std::vector<State<double>>*) override {
    return false;
  }
};

struct IdasEquationsTest : ::testing::Test {
  IdasEquationsTest()
      : system(servo("{}")),
        layout(system->layout()),
        context(make_context()),
        newton(*system, context.get()),
        equations(*system, &newton) {
    Assembly assembly(*system);
    equations.equations().set_design(system->parameters());
    if (!assembly.solve(system->parameters(), &equations.equations(), &state).ok())
      throw std::logic_error("the start cannot be assembled");
    for (VectorHandle* vector : {&y, &y_dot, &F})
      *vector = make_vector(equations.size(), context.get());
    equations.pack(state, data(y), data(y_dot));
  }
  static Span<double> data(const VectorHandle& vector) { return span_of(vector.get()); }
  Eigen::Map<VectorX<double>> residual() {
    EXPECT_EQ(IdasEquations::residual(0.0, y.get(), y_dot.get(), F.get(), &equations), 0);
    return {data(F).data(), equations.size()};
  }

  std::shared_ptr<const CompiledSystem> system;
  const Layout& layout;
  ContextHandle context;
  IdasNewton newton;
  IdasEquations equations;
  State<double> state;
  VectorHandle y, y_dot, F;
};

TEST_F(IdasEquationsTest, AStateSurvivesPacking) {
  State<double> back;
  back.resize(layout);
  equations.unpack(0.25, data(y), data(y_dot), &back);
  EXPECT_EQ(back.t, 0.25);
  EXPECT_EQ(back.q, state.q);
  EXPECT_EQ(back.v, state.v);
  EXPECT_EQ(back.s, state.s);
  EXPECT_EQ(back.z, state.z);
}

TEST_F(IdasEquationsTest, AnAssembledStartSolvesThem) {
  EXPECT_LT(residual().cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(IdasEquationsTest, EveryRowIsWhereItShouldBe) {
  data(y_dot)[1] += 0.5;                         // q'
  data(y_dot)[2 * layout.n] += 0.25;             // s'
  data(y)[2 * layout.n + layout.states] += 2.0;  // lambda: moves rows of motion alone
  const VectorX<double> r = residual();
  EXPECT_NEAR(r[1], 0.5, 1e-12);
  EXPECT_NEAR(r[equations.size() - 1], 0.25, 1e-9);
  EXPECT_GT(r.segment(layout.n, layout.n).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT(r.segment(2 * layout.n, layout.m).cwiseAbs().maxCoeff(), 1e-9);
}

// With kappa = 20 / 0.6 s, a body 1 mm off its joint and at rest relative to it is drawn back with
// kappa^2 1 mm.
TEST_F(IdasEquationsTest, DriftIsDrawnBack) {
  data(y)[0] += 1e-3;
  const VectorX<double> r = residual();
  const double kappa = 20.0 / 0.6;
  EXPECT_NEAR(r.segment(2 * layout.n, layout.m).cwiseAbs().maxCoeff(), kappa * kappa * 1e-3, 1e-6);
}

TEST_F(IdasEquationsTest, WhatIsNotFiniteIsTriedAgain) {
  data(y)[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(IdasEquations::residual(0.0, y.get(), y_dot.get(), F.get(), &equations), 0);
}

TEST_F(IdasEquationsTest, ExceptionsStayOnThisSide) {
  Faulty faulty;
  equations.set_sensitivities(&faulty);
  N_Vector one[] = {y.get()}, two[] = {y_dot.get()}, three[] = {F.get()};
  EXPECT_LT(IdasEquations::sensitivity_residual(1, 0.0, y.get(), y_dot.get(), F.get(), one, two,
                                                three, &equations, nullptr, nullptr, nullptr),
            0);
  EXPECT_EQ(equations.failure(), "no derivatives today");
}

}  // namespace
}  // namespace codesign
