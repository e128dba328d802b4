// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/tangent_step.h"

#include <gtest/gtest.h>

#include "integration/servo.h"

namespace codesign {
namespace {

using C = std::complex<double>;
constexpr double kSize = 2e-3;
constexpr int kSteps = 5;

/// A few steps of the servo, their tangent by lanes, and the same steps with one parameter moved along the imaginary axis.
class TangentStepTest : public ::testing::Test {
 protected:
  TangentStepTest() : step(*system, rodas4()), tangent(*system, rodas4()), assembly(*system) {
    const std::vector<double> parameters = system->parameters();
    step.equations().set_design(parameters);
    EXPECT_TRUE(assembly.solve(parameters, &step.equations(), &initial).ok());
    step.start(initial);
    std::vector<Lanes<4>> lanes(parameters.begin(), parameters.end());
    for (std::size_t k = 0; k < 4; ++k) lanes[k].v[static_cast<int>(k)] = 1.0;
    tangent.start(lanes, assembly, initial);
  }

  void advance() {
    for (int k = 0; k < kSteps; ++k) {
      ASSERT_TRUE(step.attempt(kSize));
      tangent.attempt(&step);
      ASSERT_TRUE(step.accept());
      tangent.accept(step);
    }
  }

  RosenbrockStep<C> shifted(std::size_t parameter, double h) {
    std::vector<C> parameters;
    for (double p : system->parameters()) parameters.emplace_back(p);
    parameters[parameter] += C(0.0, h);
    RosenbrockStep<C> run(*system, rodas4());
    run.equations().set_design(parameters);
    State<C> start;
    assembly.extend(parameters, initial, &run.equations(), &start);
    run.start(start);
    for (int k = 0; k < kSteps; ++k) EXPECT_TRUE(run.attempt(kSize) && run.accept());
    return run;
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  RosenbrockStep<double> step;
  TangentStep<4> tangent;
  Assembly assembly;
  State<double> initial;
};

TEST_F(TangentStepTest, IsTheDerivativeOfTheStepsToRounding) {
  advance();
  const IncrementLayout& at = step.increment_layout();
  constexpr double h = 1e-30;
  for (std::size_t k = 0; k < 4; ++k) {
    const RosenbrockStep<C> run = shifted(k, h);
    const auto row = static_cast<Eigen::Index>(k);
    const auto compare = [&](const VectorX<C>& value, int first) {
      const Eigen::VectorXd expected = value.imag() / h, actual = tangent.directions().row(row).segment(first, value.size()).transpose();
      EXPECT_LT((actual - expected).norm(), 1e-11 * (1.0 + expected.norm())) << "parameter " << k;
    };
    compare(run.state().q, at.x());
    compare(run.state().s, at.s());
    compare(run.state().v, at.v());
    compare(run.state().z, at.z());
    EXPECT_NEAR(tangent.psi()[row], run.psi().imag() / h, 1e-12 * (1.0 + std::abs(run.psi().imag() / h)));
  }
}

TEST_F(TangentStepTest, ErrorFallsWithTheStep) {
  ASSERT_TRUE(step.attempt(kSize));
  tangent.attempt(&step);
  const double coarse = tangent.error(1e-6);
  EXPECT_GT(coarse, 0.0);
  EXPECT_NEAR(tangent.error(1e-5), 0.1 * coarse, 1e-12 * coarse);
  ASSERT_TRUE(step.attempt(0.25 * kSize));
  tangent.attempt(&step);
  EXPECT_LT(tangent.error(1e-6), 0.1 * coarse);
}

}  // namespace
}  // namespace codesign
