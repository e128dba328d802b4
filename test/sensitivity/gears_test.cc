// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients by the numbers of gears that lose torque, and of friction in N m.
#include <gtest/gtest.h>

#include <set>

#include "integration/mechanisms.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

using Numbers = std::vector<std::pair<std::string, std::string>>;  // attribute and value

/// Attributes with twins by factors of 1, parameters of the same names after a prefix: derivatives
/// by them compare how much the numbers count.
std::string twins(const std::string& prefix, const Numbers& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers)
    text += " " + name + "='" + value + "' codesign:" + name + "='${" + value + "*" + prefix +
            name + "}'";
  return text;
}

std::string declared(const std::string& prefix, const Numbers& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers)
    text += "<codesign:parameter name='" + prefix + name + "' value='1'/>";
  return text;
}

std::string tuned(const std::string& prefix, const Numbers& numbers,
                  const std::set<std::string>& fixed) {
  std::string text;
  for (const auto& [name, value] : numbers)
    if (fixed.count(name) == 0) text += prefix + name + ": {tune: true}, ";
  return text;
}

/// A double pendulum with a gear at the shoulder and friction in N m at the elbow.
struct Geared {
  Numbers gear, friction;
  std::string model, start = "1.0";
  std::set<std::string> fixed{};  ///< numbers that are not tuned

  std::string urdf() const {
    return robot(declared("g_", gear) + declared("f_", friction) + bar("upper") + bar("lower") +
                 hinge("shoulder", "ground", "upper", "0 0 0",
                       "<codesign:actuator" + twins("g_", gear) + model + "/>") +
                 hinge("elbow", "upper", "lower", "0 0 -1",
                       "<codesign:friction" + twins("f_", friction) + model + "/>"));
  }
  std::string study(const std::string& solver) const {
    return "duration: 0.3\ninitial_state: {shoulder: {position: " + start +
           "}, elbow: {velocity: 1.0}}\n"
           "controllers: {motor: {type: state_feedback, output: shoulder, feedforward: {type: "
           "sine, "
           "amplitude: 15.0, frequency: 2.0}}}\nparameters: {" +
           tuned("g_", gear, fixed) + tuned("f_", friction, fixed) +
           "}\nobjective: {integral: [{signal: elbow/velocity}, {signal: shoulder/gear_torque, "
           "weight: 1e-2}, {signal: shoulder/gear_loss, weight: 0.1}, {signal: elbow/friction}], "
           "terminal: [{signal: shoulder/position}]}\nsolver: {" +
           solver + "}\n";
  }
  GradientCheck check(const std::string& solver, CheckMethod method) const {
    const Problem problem = load_problem({"test.urdf", urdf()}, {}, {"test.yaml", study(solver)});
    return check_gradient(problem, problem.start(), method);
  }
};

Geared smooth() {
  return {{{"gear_ratio", "-12"},
           {"rotor_inertia", "2e-3"},
           {"efficiency", "0.8"},
           {"backdrive_efficiency", "0.65"},
           {"coulomb", "0.05"},
           {"viscous", "0.002"},
           {"transition_velocity", "0.2"},
           {"smoothing", "0.3"}},
          {{"coulomb", "0.4"},
           {"static", "0.6"},
           {"coulomb_backward", "0.5"},
           {"stribeck_velocity", "0.5"},
           {"transition_velocity", "0.2"},
           {"viscous", "0.3"},
           {"viscous_exponent", "0.6"}},
          ""};
}

Geared with_bristles() {
  return {{{"gear_ratio", "12"},
           {"rotor_inertia", "2e-3"},
           {"efficiency", "0.8"},
           {"coulomb", "0.05"},
           {"bristle_stiffness", "50"}},
          {{"coulomb", "0.4"},
           {"static", "0.6"},
           {"transition_velocity", "0.5"},
           {"bristle_stiffness", "20"}},
          " model='lugre'"};
}

/// The motor starts where the joint does, so that its start depends on the stiffness, too. It goes
/// through the play and back.
Geared elastic() {
  Geared geared = smooth();
  geared.start = "\"${0.9 + 0.1*g_stiffness}\"";
  for (const auto& number : Numbers{{"stiffness", "400"}, {"damping", "1"}, {"backlash", "0.02"}})
    geared.gear.push_back(number);
  return geared;
}

TEST(GearGradients, AreThoseOfTheStepsTaken) {
  for (const Geared& geared : {smooth(), with_bristles(), elastic()})
    for (const char* solver : {"coordinates: joint", "coordinates: absolute, gradient: adjoint"}) {
      const GradientCheck exact = geared.check(solver, CheckMethod::kComplexStep);
      ASSERT_TRUE(exact.status.ok()) << solver << exact.status.cause;
      EXPECT_LT(exact.largest_relative_difference, 1e-8) << solver << geared.model;
      EXPECT_GT(exact.evaluation.gradient.cwiseAbs().minCoeff(), 1e-7) << "every number counts";
    }
}

// Differences of runs are as exact as the runs: with tolerances of 1e-9 they are off by 1e-6, with
// these by less than 1e-8 for numbers that count as much as the others.
TEST(GearGradients, AreThoseOfIndependentRuns) {
  const auto expect_same = [](Geared geared, const std::string& coordinates) {
    for (const Numbers* numbers : {&geared.gear, &geared.friction})
      for (const auto& [name, value] : *numbers)
        if (name != "efficiency" && name != "stiffness" && name != "damping" &&
            name != "backlash" && (name != "coulomb" || geared.gear.size() > smooth().gear.size()))
          geared.fixed.insert(name);
    const GradientCheck check = geared.check(
        "relative_tolerance: 1.0e-13, absolute_tolerance: 1.0e-14, coordinates: " + coordinates,
        CheckMethod::kRidders);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-8) << coordinates;
  };
  expect_same(smooth(), "joint");
  expect_same(smooth(), "absolute");
  expect_same(elastic(), "joint");
}

TEST(GearGradients, BothIntegratorsAgree) {
  const auto gradient = [](const char* integrator) {
    const Problem problem =
        load_problem({"test.urdf", smooth().urdf()}, {},
                     {"test.yaml", smooth().study(std::string("integrator: ") + integrator +
                                                  ", coordinates: absolute, relative_tolerance: "
                                                  "1.0e-9, absolute_tolerance: 1.0e-10")});
    const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
    EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    return evaluation.gradient;
  };
  const Eigen::VectorXd exact = gradient("rosenbrock");
  EXPECT_LT((gradient("idas") - exact).norm(), 1e-4 * exact.norm());
}

}  // namespace
}  // namespace codesign
