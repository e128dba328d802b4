// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/one_step.h"

#include <gtest/gtest.h>

#include "description/solver_names.h"
#include "integration/equal_steps.h"
#include "integration/servo.h"
#include "integration/tableaus.h"

namespace codesign {
namespace {

class OneStepTest : public ::testing::TestWithParam<const RosenbrockTableau*> {
 protected:
  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  OneStep<double> step{*system, *GetParam()};

  /// The state after a span in `count` equal steps.
  State<double> run(double span, int count) {
    take_equal_steps(*system, span, count, &step);
    return step.state();
  }
};

TEST_P(OneStepTest, ConvergesWithItsOrder) {
  const auto distance = [](const State<double>& x, const State<double>& y) {
    return (x.q - y.q).norm() + (x.v - y.v).norm();
  };
  const State<double> exact = run(0.02, 400);
  const double ratio = distance(run(0.02, 20), exact) / distance(run(0.02, 40), exact);
  // Halving the step gains 2^order; projection and the first steps blur it a little.
  EXPECT_GT(ratio, 0.7 * std::pow(2.0, step.tableau().order));
}

// What a step leaves depends on its error: a method of low order takes shorter steps.
TEST_P(OneStepTest, EndsOnTheConstraints) {
  const State<double> end = run(0.1, step.tableau().order < 4 ? 40 : 10);
  VectorX<double> Phi, rates;
  step.equations().constraint_errors(end, &Phi, &rates);
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(rates.cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(OneStepTest, DenseOutputMeetsBothEndsAndTheMiddle) {
  const double span = step.tableau().order < 4 ? 0.0025 : 0.01;
  const State<double> end = run(span, 1);
  State<double> at;
  double psi = 0.0;
  step.interpolate(1.0, &at, &psi);
  EXPECT_LT((at.q - end.q).norm() + (at.v - end.v).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(psi, step.psi());
  step.interpolate(0.5, &at, &psi);
  EXPECT_LT((at.q - run(0.5 * span, 10).q).norm(), 1e-5);
}

TEST_P(OneStepTest, ErrorIsThatOfTheEmbeddedSolution) {
  run(0.01, 1);
  ASSERT_TRUE(step.attempt(0.01));
  const double coarse = step.error(1e-6, 1e-6);
  EXPECT_NEAR(step.error(1e-7, 1e-7) / coarse, 10.0, 1e-9);
  ASSERT_TRUE(step.attempt(0.005));
  EXPECT_LT(step.error(1e-6, 1e-6), 0.2 * coarse);
}

INSTANTIATE_TEST_SUITE_P(Methods, OneStepTest, ::testing::ValuesIn(all_tableaus()), tableau_name);

}  // namespace
}  // namespace codesign
