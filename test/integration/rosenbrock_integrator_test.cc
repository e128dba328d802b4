// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rosenbrock_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "equations/compiled.h"

namespace codesign {
namespace {

CompiledSystem swinging(const std::string& solver, const std::string& urdf = pendulum()) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return CompiledSystem(
      robot, read_study({"test.yaml", let_go("{hinge: {position: 1.0}}", "hinge/velocity",
                                             "solver: " + solver + "\n")},
                        robot));
}

/// Integrates to `time` and returns the largest step size [s].
double run(RosenbrockIntegrator* integrator, double time) {
  double largest = 0.0;
  while (integrator->step().state().t < time) {
    const Status status = integrator->advance(time);
    EXPECT_TRUE(status.ok()) << status.cause;
    if (!status.ok()) break;
    largest = std::max(largest, integrator->step().step_size());
  }
  return largest;
}

TEST(RosenbrockIntegrator, EndsOnItsLimitToTheLastDigit) {
  const CompiledSystem system = swinging("{}");
  RosenbrockIntegrator integrator(system);
  ASSERT_TRUE(integrator.start({}).ok());
  run(&integrator, 0.7);
  EXPECT_DOUBLE_EQ(integrator.step().state().t, 0.7);
}

TEST(RosenbrockIntegrator, TighterTolerancesTakeMoreStepsToABetterEnd) {
  const CompiledSystem loose = swinging("{relative_tolerance: 1.0e-4, absolute_tolerance: 1.0e-5}"),
                       tight = swinging("{relative_tolerance: 1.0e-7, absolute_tolerance: 1.0e-8}"),
                       exact =
                           swinging("{relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-12}");
  RosenbrockIntegrator a(loose), b(tight), c(exact);
  for (RosenbrockIntegrator* integrator : {&a, &b, &c}) {
    ASSERT_TRUE(integrator->start({}).ok());
    run(integrator, 1.0);
  }
  EXPECT_LT(a.statistics().steps, b.statistics().steps);
  const auto error = [&c](const RosenbrockIntegrator& x) {
    return (x.step().state().q - c.step().state().q).norm();
  };
  EXPECT_LT(error(a), 1e-3);
  EXPECT_LT(error(b), 1e-6);
  EXPECT_LT(error(b), 0.1 * error(a));
}

TEST(RosenbrockIntegrator, StartsAnewWithTheSameDigits) {
  const CompiledSystem system = swinging("{}");
  RosenbrockIntegrator integrator(system);
  ASSERT_TRUE(integrator.start({}).ok());
  run(&integrator, 1.0);
  const Eigen::VectorXd first = integrator.step().state().q;
  const auto steps = integrator.statistics().steps;
  ASSERT_TRUE(integrator.start({}).ok());
  EXPECT_EQ(integrator.statistics().steps, 0);
  run(&integrator, 1.0);
  EXPECT_EQ(integrator.step().state().q, first);
  EXPECT_EQ(integrator.statistics().steps, steps);
}

TEST(RosenbrockIntegrator, KeepsToTheStepsOfTheStudy) {
  const CompiledSystem system = swinging("{initial_step: 1.0e-4, maximum_step: 0.01}");
  RosenbrockIntegrator integrator(system);
  ASSERT_TRUE(integrator.start({}).ok());
  ASSERT_TRUE(integrator.advance(1.0).ok());
  EXPECT_EQ(integrator.step().step_size(), 1e-4);
  EXPECT_LE(run(&integrator, 0.5), 0.01 + 1e-15);
}

TEST(RosenbrockIntegrator, TheTangentIsCalledOncePerAcceptedStep) {
  const CompiledSystem system = swinging("{}");
  RosenbrockIntegrator integrator(system);
  ASSERT_TRUE(integrator.start({}).ok());
  int calls = 0;
  while (integrator.step().state().t < 1.0) {
    const double before = integrator.step().state().t;
    ASSERT_TRUE(integrator
                    .advance(1.0,
                             [&](OneStep<double>* step) {
                               ++calls;
                               EXPECT_EQ(step->state().t, before) << "before the step is taken";
                               return 0.0;
                             })
                    .ok());
  }
  EXPECT_EQ(calls, integrator.statistics().steps);
}

TEST(RosenbrockIntegrator, ATangentMayRefuseAStep) {
  const CompiledSystem system = swinging("{}");
  RosenbrockIntegrator integrator(system);
  ASSERT_TRUE(integrator.start({}).ok());
  std::vector<double> sizes;
  ASSERT_TRUE(integrator
                  .advance(1.0,
                           [&sizes](OneStep<double>* step) {
                             sizes.push_back(step->step_size());
                             return sizes.size() < 3 ? 10.0 : 0.0;
                           })
                  .ok());
  ASSERT_EQ(sizes.size(), 3U);
  EXPECT_LT(sizes[1], sizes[0]);
  EXPECT_LT(sizes[2], sizes[1]);
  EXPECT_EQ(integrator.statistics().steps, 1);
  EXPECT_EQ(integrator.statistics().rejected_steps, 2);
}

TEST(RosenbrockIntegrator, TooManyStepsAndAnImpossibleDesignAreStatuses) {
  const CompiledSystem short_of_steps = swinging("{maximum_steps: 3}");
  RosenbrockIntegrator integrator(short_of_steps);
  ASSERT_TRUE(integrator.start({}).ok());
  Status status;
  while (status.ok()) status = integrator.advance(1.0);
  EXPECT_EQ(status.code, StatusCode::kTooManySteps);
  EXPECT_GT(status.time, 0.0);

  const std::string urdf =
      "<robot name='t' xmlns:codesign='urn:t'><codesign:parameter name='m' value='1' lower='-1' "
      "upper='2'/><link name='ground'/>"
      "<link name='bar'><inertial><mass value='1' codesign:value='${m}'/><inertia ixx='1' ixy='0' "
      "ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial></link>" +
      hinge("hinge", "ground", "bar", "0 0 0") + "</robot>";
  const CompiledSystem system = swinging("{}", urdf);
  RosenbrockIntegrator other(system);
  EXPECT_TRUE(other.start({1.0}).ok());
  EXPECT_TRUE(other.start({0.0}).ok()) << "a rotor without mass";
  status = other.start({-1.0});
  EXPECT_EQ(status.code, StatusCode::kInvalidDesign);
  EXPECT_NE(status.cause.find("'bar'"), std::string::npos);
}

}  // namespace
}  // namespace codesign
