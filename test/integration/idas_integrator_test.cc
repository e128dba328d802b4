// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/idas_integrator.h"

#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

const char* const kTightIdas =
    "{integrator: idas, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}";
const char* const kTightRosenbrock =
    "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-10, absolute_tolerance: "
    "1.0e-11}";

/// Integrates to the end, taking dense output at each of `times` on the way.
Status run(Integrator* integrator, const CompiledSystem& system,
           const std::vector<double>& times = {}, std::vector<State<double>>* samples = nullptr,
           std::vector<double>* psi = nullptr) {
  Status status = integrator->start(system.parameters());
  for (std::size_t next = 0; status.ok() && integrator->state().t < system.study().duration;) {
    status = integrator->advance(system.study().duration);
    for (; status.ok() && next < times.size() && times[next] <= integrator->state().t; ++next) {
      State<double> sample;
      double value = 0.0;
      sample.resize(system.layout());
      integrator->interpolate(times[next], &sample, &value);
      samples->push_back(sample);
      psi->push_back(value);
    }
  }
  return status;
}

void expect_agreement(const std::string& urdf, const std::string& study_with_solver_left_out) {
  const std::vector<double> times = {0.0, 0.1, 0.123456, 0.35, 0.5};
  std::vector<State<double>> samples[2];
  std::vector<double> psi[2];
  State<double> end[2];
  for (int k = 0; k < 2; ++k) {
    const auto system = compile(
        urdf, study_with_solver_left_out + "solver: " + (k ? kTightIdas : kTightRosenbrock) + "\n");
    const auto integrator = make_integrator(*system);
    const Status status = run(integrator.get(), *system, times, &samples[k], &psi[k]);
    ASSERT_TRUE(status.ok()) << status.cause;
    ASSERT_EQ(samples[k].size(), times.size());
    end[k] = integrator->state();
    psi[k].push_back(integrator->psi());
    EXPECT_EQ(end[k].t, system->study().duration);
  }
  EXPECT_LT((end[0].q - end[1].q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((end[0].v - end[1].v).cwiseAbs().maxCoeff(), 1e-5);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_EQ(samples[1][k].t, times[k]);
    EXPECT_LT((samples[0][k].q - samples[1][k].q).cwiseAbs().maxCoeff(), 1e-6) << times[k];
    EXPECT_LT((samples[0][k].v - samples[1][k].v).cwiseAbs().maxCoeff(), 1e-5) << times[k];
  }
  for (std::size_t k = 0; k < psi[0].size(); ++k)
    EXPECT_NEAR(psi[0][k], psi[1][k], 1e-6 * (1.0 + std::abs(psi[0][k]))) << k;
}

std::string swing(const std::string& initial, const std::string& signal) {
  return "duration: 0.5\ninitial_state: " + initial +
         "\nobjective: {integral: [{signal: " + signal + "}]}\n";
}

TEST(IdasIntegrator, AgreesWithRosenbrockOnAPendulum) {
  expect_agreement(pendulum(pin_friction()), swing("{hinge: {position: 1.0}}", "hinge/velocity"));
}

TEST(IdasIntegrator, AgreesWithRosenbrockOnRedundantConstraints) {
  expect_agreement(four_bar(pin_friction()),
                   swing("{left_hinge: {position: 0.6, velocity: 1.0}}", "left_hinge/velocity"));
}

TEST(IdasIntegrator, AgreesWithRosenbrockWithAnExtraState) {
  std::string study = servo_study("");
  expect_agreement(double_pendulum(pin_friction()), study.substr(0, study.rfind("solver:")));
}

TEST(IdasIntegrator, DriftStaysOfTheOrderOfTheTolerance) {
  for (const auto& [tolerance, bound] : {std::pair{"1.0e-5", 1e-3}, std::pair{"1.0e-8", 1e-6}}) {
    const std::string solver = std::string("{integrator: idas, relative_tolerance: ") + tolerance +
                               ", absolute_tolerance: " + tolerance + "}";
    const auto system =
        compile(double_pendulum(),
                "duration: 20.0\ninitial_state: {shoulder: {position: 2.0}}\nobjective: {integral: "
                "[{signal: elbow/velocity}]}\nsolver: " +
                    solver + "\n");
    IdasIntegrator integrator(*system);
    const Status status = run(&integrator, *system);
    ASSERT_TRUE(status.ok()) << status.cause;
    EXPECT_GT(integrator.largest_drift(), 0.0);
    EXPECT_LT(integrator.largest_drift(), bound);
  }
}

TEST(IdasIntegrator, StartsAnewToTheLastBit) {
  const auto system = servo(kTightIdas);
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(run(&integrator, *system).ok());
  const State<double> first = integrator.state();
  const double psi = integrator.psi();
  const auto steps = integrator.statistics().steps;
  // A run of another design that is not finished.
  std::vector<double> other = system->parameters();
  other[0] *= 2.0;
  ASSERT_TRUE(integrator.start(other).ok());
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(integrator.advance(0.6).ok());
  ASSERT_TRUE(run(&integrator, *system).ok());
  EXPECT_EQ(integrator.state().q, first.q);
  EXPECT_EQ(integrator.state().v, first.v);
  EXPECT_EQ(integrator.psi(), psi);
  EXPECT_EQ(integrator.statistics().steps, steps);
}

TEST(IdasIntegrator, StopsAtEveryLimitAndGoesOn) {
  const auto system = servo(kTightIdas);
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  for (double limit : {0.1, 0.1000001, 0.25, 0.6, 1.3}) {
    while (integrator.state().t < limit) ASSERT_TRUE(integrator.advance(limit).ok());
    EXPECT_EQ(integrator.state().t, limit);
  }
}

TEST(IdasIntegrator, ObeysItsOptions) {
  const auto few = servo("{integrator: idas, maximum_steps: 10}");
  IdasIntegrator stopped(*few);
  const Status status = run(&stopped, *few);
  EXPECT_EQ(status.code, StatusCode::kTooManySteps);
  EXPECT_GT(status.time, 0.0);
  EXPECT_EQ(stopped.statistics().steps + stopped.statistics().rejected_steps, 10);
  const auto small = servo("{integrator: idas, maximum_step: 0.001, initial_step: 1.0e-6}");
  IdasIntegrator slow(*small);
  ASSERT_TRUE(slow.start(small->parameters()).ok());
  ASSERT_TRUE(slow.advance(0.6).ok());
  EXPECT_LE(slow.state().t, 1e-6);
  double longest = 0.0;
  for (double last = slow.state().t; last < 0.6; last = slow.state().t) {
    ASSERT_TRUE(slow.advance(0.6).ok());
    longest = std::max(longest, slow.state().t - last);
  }
  EXPECT_LE(longest, 0.001 * (1.0 + 1e-12));
}

// A controller with the wrong sign makes the speed grow by e every 30 microseconds.
TEST(IdasIntegrator, WhatRunsAwayEndsWithAStatus) {
  const auto system = compile(
      pendulum(),
      "duration: 0.5\ninitial_state: {hinge: {velocity: 1.0}}\n"
      "controllers: {c: {type: pid, input: hinge/velocity, setpoint: 0.0, output: hinge, gains: "
      "{p: \"${gain}\"}}}\n"
      "parameters: {gain: {initial: 1.0}}\nobjective: {terminal: [{signal: hinge/velocity}]}\n"
      "solver: {integrator: idas, maximum_steps: 20000}\n");
  IdasIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({-1e4}).ok());
  Status status;
  while (status.ok() && integrator.state().t < 0.5) status = integrator.advance(0.5);
  EXPECT_FALSE(status.ok());
  EXPECT_GT(status.time, 0.0);
  EXPECT_LT(status.time, 0.5);
  EXPECT_FALSE(status.cause.empty());
  // The integrator can be used again afterwards.
  EXPECT_TRUE(run(&integrator, *system).ok());
}

}  // namespace
}  // namespace codesign
