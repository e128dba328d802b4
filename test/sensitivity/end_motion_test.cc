// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Runs whose end depends on the design, theory (21g), against closed forms.
#include "sensitivity/end_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {
namespace {

/// A mass of 1 kg that slides along x on a carriage of 2 kg that slides along z.
constexpr const char* kThrown = R"(<robot name="thrown" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="carriage"><inertial><mass value="2"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="ball"><inertial><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="rise" type="prismatic"><parent link="ground"/><child link="carriage"/>
    <axis xyz="0 0 1"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
  <joint name="run" type="prismatic"><parent link="carriage"/><child link="ball"/>
    <axis xyz="1 0 0"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
</robot>)";

/// A number of the watched signals, by its place, with its gradient.
struct Expected {
  int place;
  double value;
  std::vector<double> gradient;
};

struct EndCase {
  const char* name;
  const char* study;
  double objective;
  std::vector<double> gradient;
  std::vector<Expected> watched;
};

std::vector<EndCase> cases_of_durations() {
  return {
      // Bang-bang, beside the optimum: v = 2 ts - T at the end.
      {"minimum time",
       R"(
duration: "${T}"
gravity: [0, 0, 0]
loads: [{joint: run, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 0.9, lower: 0.1, upper: 3}, T: {initial: 2.1, lower: 0.5, upper: 4}}
objective: {terminal: [{signal: end_time}]}
final:
  - {signal: run/position, between: [1, 1]}
  - {signal: run/velocity, between: [0, 0]}
  - {signal: end_time, at_most: 3})",
       2.1 * 2.1,
       {0.0, 4.2},
       {{0, 0.9 * 0.9 / 2 + 0.9 * 1.2 - 1.2 * 1.2 / 2, {2.4, -0.3}},
        {1, -0.3, {2.0, -1.0}},
        {2, 2.1, {0.0, 1.0}}}},
      // The same by penalties: x(T) = 0.765, v(T) = -0.3.
      {"minimum time by penalties",
       R"(
duration: "${T}"
gravity: [0, 0, 0]
loads: [{joint: run, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 0.9, lower: 0.1, upper: 3}, T: {initial: 2.1, lower: 0.5, upper: 4}}
objective:
  terminal:
    - {signal: end_time}
    - {signal: run/position, reference: 1.0, weight: 10.0}
    - {signal: run/velocity, weight: 5.0})",
       2.1 * 2.1 + 10 * 0.235 * 0.235 + 5 * 0.09,
       {-20 * 0.235 * 2.4 - 10 * 0.3 * 2.0, 4.2 + 20 * 0.235 * 0.3 + 10 * 0.3},
       {}},
      // x = t, and a reference of the terminal term that moves.
      {"Bolza",
       R"(
duration: "${T}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 1.0}}
parameters: {T: {initial: 1.5, lower: 0.5, upper: 4}}
objective:
  integral: [{signal: run/position, reference: 1.0}]
  terminal:
    - {signal: run/position, reference: 3.0, weight: 2.0}
    - {signal: run/position, reference: "${0.5*t}"})",
       (0.125 + 1.0) / 3.0 + 2.0 * 2.25 + 0.75 * 0.75,
       {0.25 - 6.0 + 0.75},
       {}},
      // The acceleration k t at the end, and half of the duration.
      {"an acceleration at the end",
       R"(
duration: "${2*half}"
gravity: [0, 0, 0]
loads: [{joint: run, effort: "${k*t}"}]
parameters: {k: {initial: 0.7, lower: 0.1, upper: 3}, half: {initial: 0.8, lower: 0.2, upper: 2}}
objective: {terminal: [{signal: run/acceleration}]})",
       1.12 * 1.12,
       {2.0 * 1.12 * 1.6, 2.0 * 1.12 * 1.4},
       {}},
  };
}

std::vector<EndCase> cases_of_conditions() {
  const double g = 9.81, s = 5.0, phi = 0.6, range = s * s * std::sin(2 * phi) / g;
  const double v0 = 3.0, F = 4.0, d = v0 * v0 / (2 * F), reached = std::sqrt(2 * 0.8);
  return {
      {"a throw that ends at the ground",
       R"(
duration: 3.0
until: "${rise/position < 0}"
initial_state: {run: {velocity: "${s*cos(phi)}"}, rise: {velocity: "${s*sin(phi)}"}}
parameters: {s: {initial: 5, lower: 1, upper: 9}, phi: {initial: 0.6, lower: 0.1, upper: 1.5}}
objective: {terminal: [{signal: run/position}]}
final: [{signal: end_time, at_most: 3}])",
       range * range,
       {2 * range * 2 * range / s, 2 * range * 2 * s * s * std::cos(2 * phi) / g},
       {{0, 2 * s * std::sin(phi) / g, {2 * std::sin(phi) / g, 2 * s * std::cos(phi) / g}}}},
      {"a brake that ends at standstill",
       R"(
duration: 5.0
until: "${run/velocity <= 0}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 3.0}}
loads: [{joint: run, effort: "${-F}"}]
parameters: {mass: {initial: 1, lower: 0.5, upper: 2}, F: {initial: 4, lower: 1, upper: 9}}
objective: {terminal: [{signal: run/position}], integral: [{signal: run/velocity}]}
final: [{signal: end_time, at_most: 3}])",
       d * d + v0 * v0 * v0 / (3 * F),
       {2 * d * d + v0 * v0 * v0 / (3 * F), -(2 * d * d + v0 * v0 * v0 / (3 * F)) / F},
       {{0, v0 / F, {v0 / F, -v0 / (F * F)}}}},
      // The load decides by the same sign as the condition.
      {"a brake of dry friction",
       R"(
duration: 5.0
until: "${run/velocity <= 0}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 3.0}}
loads: [{joint: run, effort: "${-F*sign(run/velocity)}"}]
parameters: {F: {initial: 4, lower: 1, upper: 9}}
objective: {terminal: [{signal: run/position}]})",
       d * d,
       {-2 * d * d / F},
       {}},
      // x = t: the integral of x^2 up to xs.
      {"one of two conditions",
       R"(
duration: 5.0
until: "${run/position > xs and t > 0.3 or t > 4}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 1.0}}
parameters: {xs: {initial: 0.8, lower: 0.5, upper: 3}}
objective: {integral: [{signal: run/position}]})",
       0.512 / 3.0,
       {0.64},
       {}},
      // Behind a threshold the force is 0.5 N: v^2 = 1 + (xe - xs).
      {"an end behind a jump",
       R"(
duration: 5.0
until: "${run/position > 2}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 1.0}}
loads: [{joint: run, effort: "${run/position > xs ? 0.5 : 0}"}]
parameters: {xs: {initial: 0.7, lower: 0.1, upper: 1.5}}
objective: {terminal: [{signal: run/velocity}, {signal: end_time}]})",
       2.3 + std::pow(0.7 + 2 * (std::sqrt(2.3) - 1), 2),
       {-1.0 + 2 * (0.7 + 2 * (std::sqrt(2.3) - 1)) * (1 - 1 / std::sqrt(2.3))},
       {}},
      // The acceleration jumps at ts, which ends the run.
      {"an end by a jump",
       R"(
duration: 5.0
until: "${run/acceleration > 0.2}"
gravity: [0, 0, 0]
initial_state: {run: {velocity: 1.0}}
loads: [{joint: run, effort: "${t > ts ? 0.5 : 0}"}]
parameters: {ts: {initial: 0.8, lower: 0.5, upper: 3}}
objective: {integral: [{signal: run/position}], terminal: [{signal: run/position}]}
final: [{signal: run/position, at_most: 3}])",
       0.512 / 3 + 0.64,
       {0.64 + 1.6},
       {{0, 0.8, {1.0}}}},
      // A peak at the end, where v = sqrt(2 xs).
      {"a peak at the end",
       R"(
duration: 5.0
until: "${run/position >= xs}"
gravity: [0, 0, 0]
loads: [{joint: run, effort: 1.0}]
parameters: {xs: {initial: 0.8, lower: 0.5, upper: 3}}
objective: {peak: [{signal: run/velocity}], maximum: [{signal: end_time, weight: 2.0}]})",
       3 * reached,
       {3 / reached},
       {}},
  };
}

EndCase one_of_two_conditions() {
  for (const EndCase& test : cases_of_conditions())
    if (std::string(test.name) == "one of two conditions") return test;
  ADD_FAILURE() << "not there";
  return {};
}

class EndMotionTest : public ::testing::TestWithParam<const char*> {
 protected:
  static std::shared_ptr<const CompiledSystem> system_of_case(const EndCase& test,
                                                              const std::string& solver) {
    const RobotDescription robot = read_urdf({"thrown.urdf", kThrown});
    return make_system(robot,
                       read_study({"study.yaml", "solver: " + solver + test.study + "\n"}, robot));
  }

  static void expect_near(const Eigen::VectorXd& gradient, const std::vector<double>& expected,
                          const std::string& name) {
    ASSERT_EQ(gradient.size(), static_cast<Eigen::Index>(expected.size())) << name;
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(gradient[static_cast<Eigen::Index>(k)], expected[k],
                  1e-6 * std::max(1.0, std::abs(expected[k])))
          << name << ", parameter " << k;
  }

  static void check(const EndCase& test, const std::string& solver) {
    const auto system = system_of_case(test, solver);
    const GradientCheck check =
        check_design(system, system->parameters(), CheckMethod::kComplexStep, nullptr, {});
    ASSERT_TRUE(check.status.ok()) << test.name << ": " << describe(check.status);
    const Evaluation& run = check.evaluation;
    EXPECT_NEAR(run.objective, test.objective, 1e-6 * std::max(1.0, test.objective)) << test.name;
    expect_near(run.gradient, test.gradient, test.name);
    for (const Expected& number : test.watched) {
      const std::string name = test.name + (", number " + std::to_string(number.place));
      EXPECT_NEAR(run.extremes.values[number.place], number.value, 1e-6) << name;
      expect_near(run.extremes.gradients.col(number.place), number.gradient, name);
    }
    EXPECT_LT(check.largest_relative_difference,
              check.method == CheckMethod::kComplexStep ? 1e-9 : 1e-5)
        << test.name;
  }
};

TEST_P(EndMotionTest, DurationsThatAreTuned) {
  for (const EndCase& test : cases_of_durations()) check(test, GetParam());
}

TEST_P(EndMotionTest, ConditionsThatEndARun) {
  for (const EndCase& test : cases_of_conditions()) check(test, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Methods, EndMotionTest,
    ::testing::Values(
        "{relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas4, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10, coordinates: "
        "absolute}",
        "{method: dopri5, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10, coordinates: "
        "absolute}"));

class EndOfIdasTest : public EndMotionTest {};

// Those that switch are left to rosenbrock.
TEST_P(EndOfIdasTest, DurationsThatAreTuned) {
  for (const EndCase& test : cases_of_durations()) check(test, GetParam());
}

TEST_P(EndOfIdasTest, ConditionsAreLeftToTheOtherIntegrator) {
  const RobotDescription robot = read_urdf({"thrown.urdf", kThrown});
  for (const EndCase& test : cases_of_conditions()) {
    const std::string text = std::string("solver: ") + GetParam() + test.study + "\n";
    Warnings warnings;
    make_system(robot, read_study({"study.yaml", text}, robot), &warnings);
    ASSERT_EQ(warnings.size(), 1U) << test.name;
    EXPECT_EQ(warnings[0].code, "other_integrator") << test.name;
    check(test, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Idas, EndOfIdasTest,
                         ::testing::Values("{integrator: idas, relative_tolerance: 1.0e-9, "
                                           "absolute_tolerance: 1.0e-10}"));

/// The adjoint has no derivatives of watched signals: the cases without them.
class EndOfAdjointTest : public EndMotionTest {
 protected:
  static void check_all(const std::vector<EndCase>& cases, const std::string& solver) {
    for (EndCase test : cases) {
      std::string study = test.study;
      if (study.find("peak:") != std::string::npos) continue;
      study.erase(std::min(study.find("\nfinal:"), study.size()));
      test.study = study.c_str();
      test.watched.clear();
      EXPECT_TRUE(prefers_adjoint(*system_of_case(test, solver))) << test.name;
      check(test, solver);
    }
  }
};

TEST_P(EndOfAdjointTest, DurationsThatAreTuned) { check_all(cases_of_durations(), GetParam()); }

TEST_P(EndOfAdjointTest, ConditionsThatEndARun) { check_all(cases_of_conditions(), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Adjoint, EndOfAdjointTest,
    ::testing::Values("{gradient: adjoint, method: rodas5p, relative_tolerance: 1.0e-9, "
                      "absolute_tolerance: 1.0e-10}",
                      "{gradient: adjoint, method: dopri5, relative_tolerance: 1.0e-9, "
                      "absolute_tolerance: 1.0e-10}",
                      "{gradient: adjoint, method: rodas4, relative_tolerance: 1.0e-9, "
                      "absolute_tolerance: 1.0e-10, coordinates: absolute}"));

TEST_F(EndMotionTest, DifferencesOfOtherRunsAgree) {
  for (const auto& cases : {cases_of_durations(), cases_of_conditions()})
    for (const EndCase& test : cases) {
      const auto system = system_of_case(test, "{}");
      const GradientCheck check =
          check_design(system, system->parameters(), CheckMethod::kRidders, nullptr, {});
      ASSERT_TRUE(check.status.ok()) << test.name << ": " << describe(check.status);
      EXPECT_LT(check.largest_relative_difference, 1e-5) << test.name;
    }
}

// The end of more parameters than one run carries.
TEST_F(EndMotionTest, ARunThatIsRepeatedForMoreParameters) {
  const auto system = system_of_case(one_of_two_conditions(), "{relative_tolerance: 1.0e-9}");
  RosenbrockGradient engine(*system, 4);
  ASSERT_TRUE(engine.start(system->parameters(), Derivatives::kGradient).ok());
  while (!engine.integrator().has_ended())
    ASSERT_TRUE(engine.advance(engine.integrator().end()).ok());
  Eigen::VectorXd gradient;
  engine.gradient(&gradient);
  EXPECT_NEAR(gradient[0], 0.64, 1e-6);
}

TEST_F(EndMotionTest, AConditionThatIsNotReachedIsAWarning) {
  EndCase test = one_of_two_conditions();
  const std::string study =
      std::string(test.study)
          .replace(std::string(test.study).find("duration: 5.0"), 13, "duration: 0.6");
  test.study = study.c_str();
  const auto system = system_of_case(test, "{}");
  const Evaluation run = evaluator_of(system).evaluate_design(system->parameters(), true);
  ASSERT_TRUE(run.status.ok());
  EXPECT_NEAR(run.objective, 0.216 / 3.0, 1e-7);
  EXPECT_NEAR(run.gradient[0], 0.0, 1e-12);
  ASSERT_EQ(run.warnings.size(), 1U);
  EXPECT_EQ(run.warnings[0].code, "until_not_reached");
  EXPECT_EQ(run.warnings[0].where.line, 3);
}

/// The fourth of sixteen windows of 9 s ends at 2.25 s: a search that brings the end there goes on.
TEST_F(EndMotionTest, AnInstantThatTheEndMeetsMovesWithIt) {
  EndCase test = one_of_two_conditions();
  test.study = R"(
duration: "${T}"
gravity: [0, 0, 0]
parameters: {T: {initial: 3.0, lower: 1.5, upper: 9.0}}
objective: {maximum: [{signal: end_time}]})";
  const auto system = system_of_case(test, "{}");
  for (const double end : {2.25, std::nextafter(2.25, 3.0), 2.25 + 1e-9}) {
    std::vector<double> parameters = system->parameters();
    parameters.back() = end;
    const Evaluation run = evaluator_of(system).evaluate_design(parameters, true);
    ASSERT_TRUE(run.status.ok()) << run.status.cause;
    EXPECT_EQ(run.extremes.gradients.row(0).segment(3, 3), Eigen::RowVector3d(0.0, 1.0, 1.0))
        << end;
  }
}

TEST_F(EndMotionTest, AConditionThatHoldsAtTheStartIsRefused) {
  EndCase test = one_of_two_conditions();
  const std::string study =
      std::string(test.study)
          .replace(std::string(test.study).find("run/position > xs and t > 0.3"), 29,
                   "run/position < xs");
  test.study = study.c_str();
  const auto system = system_of_case(test, "{}");
  const Evaluation run = evaluator_of(system).evaluate_design(system->parameters(), true);
  EXPECT_EQ(run.status.code, StatusCode::kInvalidDesign);
  for (const char* part : {"study.yaml:3", "until", "true at the start", "run/position < xs"})
    EXPECT_NE(run.status.cause.find(part), std::string::npos) << run.status.cause;
}

}  // namespace
}  // namespace codesign
