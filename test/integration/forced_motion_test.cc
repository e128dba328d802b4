// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Equations that depend on time through setpoints and references: order, both integrators,
// gradients.
#include <gtest/gtest.h>

#include "description/solver_names.h"
#include "integration/equal_steps.h"
#include "integration/integrator.h"
#include "integration/one_step.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// A double pendulum whose shoulder follows a sine and whose elbow follows way-points; every number
/// a parameter where it can be.
std::string forced_study(const std::string& solver) {
  return "duration: 1.0\ninitial_state: {shoulder: {position: 0.2}, elbow: {position: -0.4, "
         "velocity: 1.0}}\n"
         "controllers:\n"
         "  servo: {type: pid, input: shoulder/position, output: shoulder, gains: {p: 60.0, i: "
         "20.0, d: 8.0},\n"
         "    setpoint: {type: sine, amplitude: \"${A}\", frequency: \"${f}\", phase: "
         "\"${phase}\", offset: 0.3}}\n"
         "  arm: {type: computed_torque, output: elbow, gains: {p: \"${stiffness}\", d: 6.0},\n"
         "    setpoint: {type: waypoints, times: [0.0, 0.4, 1.1], positions: [-0.4, "
         "\"${through}\", 0.2]}}\n"
         "  help: {type: state_feedback, output: elbow, feedforward: {type: sine, amplitude: 0.4, "
         "period: 0.7},\n"
         "    feedback: [{signal: lower/velocity/x, gain: \"${K}\", reference: {type: sine, "
         "amplitude: 0.3, frequency: 1.1}}]}\n"
         "  push: {type: basis, shape: cubic, output: shoulder, coefficients: {count: 6, initial: "
         "[0, 1, -1, 2, 0, 1]}}\n"
         "parameters: {A: {initial: 0.5}, f: {initial: 0.9}, phase: {initial: 0.2}, through: "
         "{initial: 0.6}, stiffness: {initial: 30.0}, "
         "K: {initial: 0.8}}\n"
         "objective:\n"
         "  integral: [{signal: servo/error}, {signal: lower/position/x, reference: {type: sine, "
         "amplitude: \"${A}\", period: 1.5}}]\n"
         "  terminal: [{signal: elbow/velocity, reference: {type: sine, amplitude: 1.0, frequency: "
         "\"${f}\"}}]\nsolver: " +
         solver + "\n";
}

std::shared_ptr<const CompiledSystem> forced(const std::string& solver) {
  return compile(double_pendulum(), forced_study(solver));
}

/// A smooth force, so that nothing but the method limits the order.
std::shared_ptr<const CompiledSystem> smoothly_forced() {
  return compile(double_pendulum(),
                 "duration: 1.0\ninitial_state: {elbow: {position: 0.5}}\ncontrollers:\n"
                 "  servo: {type: pid, input: shoulder/position, output: shoulder, gains: {p: "
                 "40.0, i: 10.0, d: 4.0},\n"
                 "    setpoint: {type: sine, amplitude: 0.8, frequency: 1.5, phase: 0.4}}\n"
                 "objective: {integral: [{signal: elbow/position, reference: {type: sine, "
                 "amplitude: 1.0, frequency: 2.0}}]}\n");
}

/// State and psi after a span in `count` equal steps.
class ForcedStep : public ::testing::TestWithParam<const char*> {
 protected:
  Eigen::VectorXd run(double span, int count) {
    take_equal_steps(*system, span, count, &step);
    Eigen::VectorXd end(2 * system->layout().n + 2);
    end << step.state().q, step.state().v, step.state().s, step.psi();
    return end;
  }

  const std::shared_ptr<const CompiledSystem> system = smoothly_forced();
  OneStep<double> step{*system, rosenbrock_tableau(method_named(GetParam()))};
};

// Without G_t and g_t the order is lost.
TEST_P(ForcedStep, ConvergesWithItsOrder) {
  const Eigen::VectorXd exact = run(0.4, 1280);
  const Eigen::VectorXd coarse = run(0.4, 80) - exact, fine = run(0.4, 160) - exact;
  const double expected = 0.7 * std::pow(2.0, step.tableau().order);
  const Eigen::Index state = coarse.size() - 1;
  EXPECT_GT(coarse.head(state).norm() / fine.head(state).norm(), expected);
  EXPECT_GT(std::abs(coarse[state] / fine[state]), expected) << "psi";
}

INSTANTIATE_TEST_SUITE_P(Methods, ForcedStep,
                         ::testing::Values("rodas4", "rodas4p2", "rodas5p", "dopri5"));

TEST(ForcedMotion, TheGradientIsThatOfTheStepsTaken) {
  for (const char* method : {"rodas4", "rodas5p", "dopri5"}) {
    const auto system = forced(std::string("{method: ") + method + "}");
    Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
    for (Eigen::Index k = 0; k < rho.size(); ++k)
      rho[k] = system->parameters()[static_cast<std::size_t>(
          system->study().tuned[static_cast<std::size_t>(k)])];
    ASSERT_EQ(rho.size(), 12);
    const GradientCheck check = check_gradient(system, rho, CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-10) << method;
    EXPECT_GT(check.evaluation.gradient.cwiseAbs().minCoeff(), 0.0) << "every parameter matters";
  }
}

TEST(ForcedMotion, BothIntegratorsAgreeOnObjectiveAndGradient) {
  const auto rosenbrock = forced(
                 "{method: rodas5p, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}"),
             idas = forced(
                 "{integrator: idas, relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}");
  const std::vector<double> values = rosenbrock->parameters();
  Eigen::VectorXd rho(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) rho[static_cast<Eigen::Index>(k)] = values[k];
  const Evaluation a = evaluator_of(rosenbrock).evaluate(rho, true),
                   b = evaluator_of(idas).evaluate(rho, true);
  ASSERT_TRUE(a.status.ok() && b.status.ok()) << b.status.cause;
  EXPECT_NEAR(b.objective / a.objective, 1.0, 1e-6);
  EXPECT_LT((b.gradient - a.gradient).norm(), 1e-5 * a.gradient.norm());
}

// The closed loop of a computed torque without friction is e'' + d e' + p e = 0, whatever the
// mechanism.
TEST(ForcedMotion, ComputedTorqueLeavesALinearError) {
  const std::string servo =
      ": {type: computed_torque, gains: {p: 16.0, d: 10.0}, setpoint: {type: sine, amplitude: 1.0, "
      "period: 1.1}, output: ";
  const auto system = compile(
      double_pendulum(),
      "duration: 1.0\ninitial_state: {shoulder: {position: 0.5}, elbow: {velocity: "
      "1.0}}\ncontrollers:\n  a" +
          servo + "shoulder}\n  b" + servo +
          "elbow}\nobjective: {integral: [{signal: a/error}]}\n"
          "solver: {method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n");
  const double w = 2.0 * M_PI / 1.1;
  // e = c e^-2t + k e^-8t from e(0) and e'(0).
  const auto error = [](double e, double rate, double t) {
    return ((8.0 * e + rate) * std::exp(-2.0 * t) - (2.0 * e + rate) * std::exp(-8.0 * t)) / 6.0;
  };
  Simulation simulation = simulation_of(system, system->parameters());
  const Status status = simulate(&simulation, 1.0, 11, [&](const Frame& frame) {
    EXPECT_NEAR(frame.controllers[0].error, error(-0.5, w, frame.time), 1e-6);
    EXPECT_NEAR(frame.controllers[1].error, error(0.0, w - 1.0, frame.time), 1e-6);
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
}

/// The shoulder's error after eight seconds of holding 0.8 rad with two controllers; `keys` of one,
/// JOINT in place of the joint.
double lasting_error(const std::string& keys) {
  std::string study = "duration: 8.0\nobjective: {integral: [{signal: a/error}]}\ncontrollers:\n";
  for (const auto& [name, joint] :
       {std::pair<std::string, std::string>{"a", "shoulder"}, {"b", "elbow"}}) {
    std::string controller = "  " + name + ": {setpoint: 0.8, output: JOINT, " + keys + "}\n";
    for (std::size_t at = controller.find("JOINT"); at != std::string::npos;
         at = controller.find("JOINT"))
      controller.replace(at, 5, joint);
    study += controller;
  }
  const auto system = compile(double_pendulum(), study);
  Simulation simulation = simulation_of(system, system->parameters());
  double error = 0.0;
  const Status status = simulate(&simulation, 8.0, 2, [&error](const Frame& frame) {
    error = frame.controllers[0].error;
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return std::abs(error);
}

TEST(ForcedMotion, GravityCompensationLeavesNoOffset) {
  EXPECT_LT(lasting_error("type: pd_gravity, gains: {p: 50.0, d: 25.0}"), 1e-3);
  EXPECT_GT(lasting_error("type: pid, input: JOINT/position, gains: {p: 50.0, d: 25.0}"), 0.05);
}

// A bar at rest allows steps of any length, over which the objective changes.
TEST(ForcedMotion, TheErrorOfTheObjectiveIsTestedWhereNothingMoves) {
  for (const char* integrator : {"rosenbrock", "idas"})
    for (const double frequency : {1.0, 3.0, 20.0}) {
      const auto system = compile(
          pendulum(),
          "duration: 2.0\ngravity: [0, 0, 0]\nobjective: {integral: [{signal: "
          "hinge/position, reference: {type: sine, amplitude: 2.0, frequency: " +
              std::to_string(frequency) + "}}]}\nsolver: {integrator: " + integrator + "}\n");
      const auto engine = make_integrator(*system);
      ASSERT_TRUE(engine->start({}).ok());
      while (engine->state().t < 2.0) ASSERT_TRUE(engine->advance(2.0).ok());
      EXPECT_NEAR(engine->psi(), 4.0, 1e-3) << integrator << frequency;  // 2 a^2 / 2
    }
}

}  // namespace
}  // namespace codesign
