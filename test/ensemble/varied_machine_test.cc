// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Uncertain numbers in given motions, in loads and in the bands of measures, and runs with other
// motions, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "ensemble/ensemble.h"
#include "integration/driven_slides.h"
#include "problem/load_problem.h"
#include "sensitivity/oscillator.h"

namespace codesign {
namespace {

/// A mass of 2 kg, parameter `mass`, on a slide. @param lines of the study
Problem slide(const std::string& lines) {
  const std::string urdf =
      "<codesign:parameter name='mass' value='2' lower='1' upper='3'/>"
      "<link name='piston'><inertial><mass value='2' codesign:value='${mass}'/><inertia ixx='1' "
      "iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>";
  return load_problem({"slide.urdf", robot(urdf + lift("slide", "piston", 0.0))}, {},
                      {"slide.yaml",
                       "duration: 1.0\ngravity: [0, 0, 0]\nsolver: {relative_tolerance: 1.0e-10, "
                       "absolute_tolerance: 1.0e-11}\n" +
                           lines});
}

/// Value of the named parameter in a design.
double at(const Problem& problem, const std::vector<double>& design, const std::string& name) {
  for (std::size_t k = 0; k < design.size(); ++k)
    if (problem.all_parameters()[k].name == name) return design[k];
  ADD_FAILURE() << name;
  return 0.0;
}

using ClosedForm = std::function<double(const std::vector<double>& design, const Scenario&)>;

/// Each scenario has the objective of a closed form, and the mean the exact gradient.
/// @param different how many different objectives there are.
void expect_scenarios(const Problem& problem, const ClosedForm& form, std::size_t different) {
  const Ensemble ensemble(problem);
  const EnsembleEvaluation all = ensemble.evaluate(problem.start(), true);
  ASSERT_TRUE(all.total.status.ok()) << all.total.status.cause;
  double mean = 0.0;
  std::set<float> values;
  ASSERT_EQ(static_cast<std::size_t>(all.values.size()), ensemble.scenarios().size());
  for (std::size_t k = 0; k < ensemble.scenarios().size(); ++k) {
    const Scenario& scenario = ensemble.scenarios()[k];
    const double expected = form(scenario.parameters(problem.start()), scenario);
    EXPECT_NEAR(all.values[static_cast<Eigen::Index>(k)], expected, 1e-7 * std::abs(expected))
        << scenario.name();
    mean += scenario.weight * expected;
    values.insert(static_cast<float>(expected));
  }
  EXPECT_EQ(values.size(), different);
  EXPECT_NEAR(all.total.objective, mean, 1e-7 * std::abs(mean));
  const GradientCheck check = check_gradient(ensemble, problem.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_GT(check.reference.cwiseAbs().minCoeff(), 0.0);
  EXPECT_LT(check.largest_relative_difference, 1e-8);
}

TEST(VariedMachine, UncertainNumbersOfAGivenMotion) {
  const Problem problem = slide(
      "parameters: {mass: {}, A: {initial: 0.5, tune: false}, w: {initial: 3.0}}\n"
      "motion: {slide: {position: \"${A*sin(w*t)}\"}}\n"
      "uncertain: {A: {uniform: [0.4, 0.6]}}\nrobust: {samples: 4}\n"
      "objective: {terminal: [{signal: slide/effort}]}\n");
  expect_scenarios(
      problem,
      [&](const std::vector<double>& design, const Scenario&) {
        return std::pow(2.0 * at(problem, design, "A") * 9.0 * std::sin(3.0), 2);
      },
      4);
}

TEST(VariedMachine, UncertainNumbersOfLoads) {
  // m v' = F t, and m v' = -c v from 1.5 m/s.
  const std::string start = "initial_state: {slide: {velocity: 1.5}}\n",
                    objective = "objective: {terminal: [{signal: slide/velocity}]}\n";
  const Problem of_time = slide(
      "parameters: {mass: {}, F: {initial: 3.0, tune: false}}\n" + objective + start +
      "loads: [{joint: slide, effort: \"${F*t}\"}]\nuncertain: {F: {uniform: [2, 4]}}\nrobust: "
      "{samples: 4}\n");
  expect_scenarios(
      of_time,
      [&](const std::vector<double>& design, const Scenario&) {
        return std::pow(1.5 + at(of_time, design, "F") / 4.0, 2);
      },
      4);
  const Problem of_signal = slide(
      "parameters: {mass: {}, c: {initial: 1.0, tune: false}}\n" + objective + start +
      "loads: [{joint: slide, effort: \"${-c*slide/velocity}\"}]\nuncertain: {c: {choice: [0.5, "
      "1.5]}}\nrobust: {samples: 4}\n");
  expect_scenarios(
      of_signal,
      [&](const std::vector<double>& design, const Scenario&) {
        return std::pow(1.5 * std::exp(-at(of_signal, design, "c") / 2.0), 2);
      },
      2);
}

// x = cos(w t) is below the edge from acos(edge)/w on.
TEST(VariedMachine, UncertainEdgesOfBands) {
  const Problem problem = oscillator(
      "duration: 0.69\nobjective: {arrival: [{signal: slide/position, band: [-1, "
      "\"${edge}\"]}]}\nuncertain: {edge: {uniform: [0.4, 0.6]}}\nrobust: {samples: 4}\n",
      "{initial: 1.0}, edge: {initial: 0.5, tune: false}");
  expect_scenarios(
      problem,
      [&](const std::vector<double>& design, const Scenario&) {
        return std::acos(at(problem, design, "edge")) / 2.0;
      },
      4);
}

TEST(VariedMachine, RunsMayHaveOtherMotions) {
  const Problem problem = slide(
      "parameters: {mass: {}, A: {initial: 0.5}}\n"
      "motion: {slide: {position: \"${A*sin(3*t)}\"}}\n"
      "runs: {as_given: {}, faster: {weight: 3.0, motion: {slide: {position: "
      "\"${A*sin(6*t)}\"}}}, by_speed: {motion: {slide: {velocity: {type: sine, amplitude: "
      "\"${A}\", period: 8.0}}}}}\n"
      "objective: {terminal: [{signal: slide/effort}]}\n");
  expect_scenarios(
      problem,
      [&](const std::vector<double>&, const Scenario& scenario) {
        const double w = scenario.name() == "run \"faster\"" ? 6.0 : 3.0,
                     effort = scenario.name() == "run \"by_speed\""
                                  ? M_PI / 4.0 * std::cos(M_PI / 4.0)
                                  : w * w * std::sin(w);
        return effort * effort;
      },
      3);
}

}  // namespace
}  // namespace codesign
