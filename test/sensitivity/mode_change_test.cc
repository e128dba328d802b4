// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of motions whose formulas switch, theory (17d), (18g), against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/gradient_engine.h"

namespace codesign {
namespace {

/// A mass of 1 kg that slides along x.
constexpr const char* kSlide = R"(<robot name="cart" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="body"><inertial><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/>
    <axis xyz="1 0 0"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
</robot>)";

struct SwitchCase {
  const char* name;
  const char* study;
  double objective;
  std::vector<double> gradient;
};

/// x(2) after the force +1 until `ts` and -1 afterwards.
double switched(double ts) {
  return ts * ts / 2.0 + ts * (2.0 - ts) - (2.0 - ts) * (2.0 - ts) / 2.0;
}

/// A pulse of 4 N from `s` on, `w` s long, whose end is asked for only behind its begin, and a
/// force that begins to grow at `tr` = `s`; x(2) = 4 w (2 - s - w/2) - (2 - tr)^3/6.
SwitchCase nested(bool pulse_first) {
  const double x = 0.4 * 1.45 - 0.5625, factor = 2.0 * (x + 1.0);
  return {pulse_first ? "a pulse and a ramp that begin together" : "a ramp and a pulse",
          pulse_first ? R"(
loads:
  - {joint: slide, effort: "${t < s ? 0 : (t < s + w ? 4 : 0)}"}
  - {joint: slide, effort: "${-max(0, t - tr)}"}
parameters: {s: {initial: 0.5, lower: 0, upper: 1}, w: {initial: 0.1, lower: 0, upper: 1},
  tr: {initial: 0.5, lower: 0, upper: 1}}
objective: {terminal: [{signal: slide/position, reference: -1}]})"
                      : R"(
loads:
  - {joint: slide, effort: "${-max(0, t - tr)}"}
  - {joint: slide, effort: "${t < s ? 0 : (t < s + w ? 4 : 0)}"}
parameters: {s: {initial: 0.5, lower: 0, upper: 1}, w: {initial: 0.1, lower: 0, upper: 1},
  tr: {initial: 0.5, lower: 0, upper: 1}}
objective: {terminal: [{signal: slide/position, reference: -1}]})",
          (x + 1.0) * (x + 1.0),
          {-0.4 * factor, 5.6 * factor, 1.125 * factor}};
}

std::vector<SwitchCase> switch_cases() {
  const double x = switched(0.8), beyond = 0.7 + 1.3 - 0.25 * 1.69;
  // Two halves of an oscillation with w = 2.2 rad/s about x = F/k and -F/k.
  const double k = 4.84, F = 0.4, cosine = std::cos(2.0 * 2.2),
               turned = -F / k - (3.0 * F / k - 1.0) * cosine;
  // floor(2 t) N: v = 0, then 0.5 (t - 0.5), ...
  return {
      {"a tuned switching time",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position, reference: 2.0}]})",
       (x - 2.0) * (x - 2.0),
       {2.0 * (x - 2.0) * 2.0 * 1.2}},
      {"a tuned threshold of a position",
       R"(
initial_state: {slide: {velocity: 1.0}}
loads: [{joint: slide, effort: "${slide/position > xs ? -0.5 : 0}"}]
parameters: {xs: {initial: 0.7, lower: 0.1, upper: 1.5}}
objective: {terminal: [{signal: slide/position}]})",
       beyond * beyond,
       {2.0 * beyond * (1.0 - (1.0 - 0.65))}},
      // The start moves the instant at which the fixed threshold is passed.
      {"a fixed threshold, a tuned start",
       R"(
initial_state: {slide: {position: "${x0}", velocity: "${v0}"}}
loads: [{joint: slide, effort: "${slide/position > 0.7 ? -0.5 : 0}"}]
parameters: {x0: {initial: 0.0, lower: -1, upper: 0.5}, v0: {initial: 1.0, lower: 0.8, upper: 3}}
objective: {terminal: [{signal: slide/position}]})",
       beyond * beyond,
       // With t_e = (0.7 - x0)/v0 and tau = 2 - t_e: x = 0.7 + v0 tau - tau^2/4.
       {2.0 * beyond * (1.0 - 0.65), 2.0 * beyond * (1.3 + (1.0 - 0.65) * 0.7)}},
      // A kink: the force max(0, t - ts) is continuous.
      {"a ramp that begins at a tuned time",
       R"(
loads: [{joint: slide, effort: "${max(0, t - ts)}"}]
parameters: {ts: {initial: 0.5, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position, reference: 0}]})",
       std::pow(std::pow(1.5, 3) / 6.0, 2),
       {-2.0 * std::pow(1.5, 3) / 6.0 * 1.5 * 1.5 / 2.0}},
      // The integrand jumps: the integral of x^2 = t^2 (v = 1) from tw on.
      {"a window of the objective",
       R"(
initial_state: {slide: {velocity: 1.0}}
parameters: {tw: {initial: 0.6, lower: 0.1, upper: 1.9}}
objective: {integral: [{signal: "${t > tw ? slide/position : 0}"}]})",
       (8.0 - 0.216) / 3.0,
       {-0.36}},
      {"the distance from a tuned place",
       R"(
initial_state: {slide: {velocity: 1.0}}
parameters: {a: {initial: 0.7, lower: 0.1, upper: 1.9}}
objective: {integral: [{signal: slide/position, reference: "${a}", loss: absolute}]})",
       (0.7 * 0.7 + 1.3 * 1.3) / 2.0,
       {0.7 - 1.3}},
      {"a soft bound at a tuned place",
       R"(
initial_state: {slide: {velocity: 1.0}}
parameters: {u: {initial: 0.7, lower: 0.1, upper: 1.9}}
objective: {integral: [{signal: slide/position, reference: "${u}", loss: above}]})",
       1.3 * 1.3 * 1.3 / 3.0,
       {-1.3 * 1.3}},
      // 2 (c - c^2 + c^3/3): linear up to 1 - c and from 1 + c on.
      {"a Huber loss of a tuned scale",
       R"(
initial_state: {slide: {velocity: 1.0}}
parameters: {c: {initial: 0.3, lower: 0.1, upper: 0.9}}
objective: {integral: [{signal: slide/position, reference: 1, loss: huber, scale: "${c}"}]})",
       2.0 * (0.3 - 0.09 + 0.009),
       {2.0 * 0.49}},
      // Two crossings, a pulse of 2 N that is 1 ms long, 0.4 m behind the start.
      {"a short pulse of a position",
       R"(
initial_state: {slide: {velocity: 1.0}}
loads: [{joint: slide, effort: "${abs(slide/position - xp) < 0.0005 ? 2/0.001*w : 0}"}]
parameters: {xp: {initial: 0.4, lower: 0.1, upper: 1.9}, w: {initial: 0.0001, lower: 0, upper: 1}}
objective: {terminal: [{signal: slide/velocity}]})",
       1.0 + 4.0e-4,
       {0.0, 4.0}},
      // Each of two instants that are equal here has its own derivative.
      {"two switching times that are equal",
       R"(
loads: [{joint: slide, effort: "${(t < t1 ? 0.5 : 0) + (t < t2 ? 0.5 : -1)}"}]
parameters: {t1: {initial: 0.8, lower: 0.1, upper: 1.9}, t2: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position}]})",
       0.56 * 0.56,
       {2.0 * 0.56 * 0.5 * 1.2, 2.0 * 0.56 * 1.5 * 1.2}},
      // The controller changes nothing, but samples at the instant of the switch.
      {"a switching time at which a controller samples",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
controllers: {c: {type: pid, input: slide/velocity, output: slide, setpoint: 0.0, sample_time: 0.1,
  gains: {p: 0.0}}}
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position, reference: 2.0}]})",
       (x - 2.0) * (x - 2.0),
       {2.0 * (x - 2.0) * 2.0 * 1.2}},
      {"a force that begins at rest",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 0 : 1}"}]
parameters: {ts: {initial: 0.7, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position}]})",
       0.845 * 0.845,
       {-2.0 * 0.845 * 1.3}},
      // The start is at rest, on the guard; the slide turns round at pi/w.
      {"dry friction by a sign, with a turn",
       R"(
initial_state: {slide: {position: "${x0}"}}
loads: [{joint: slide, effort: "${-4.84*slide/position - F*sign(slide/velocity)}"}]
parameters: {x0: {initial: 1, lower: 0.5, upper: 2}, F: {initial: 0.4, lower: 0.1, upper: 1}}
objective: {terminal: [{signal: slide/position}]})",
       turned * turned,
       {2.0 * turned * cosine, -2.0 * turned * (1.0 + 3.0 * cosine) / k}},
      // max() changes its side because the acceleration jumps, at an instant that is not its own.
      {"a guard that jumps",
       R"(
loads: [{joint: slide, effort: "${t < ts ? -1 : 1}"}]
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {integral: [{signal: "${max(slide/acceleration, 0)}"}]})",
       1.2,
       {-1.0}},
      // floor(2 t) N on 1 kg: 0, 1, 2, 3 N for half a second each.
      {"steps of time",
       R"(
loads: [{joint: slide, effort: "${c*floor(2*t/period)}"}]
parameters: {period: {initial: 1.0, lower: 0.5, upper: 2}, c: {initial: 1.0, lower: 0, upper: 2}}
objective: {terminal: [{signal: slide/velocity}]})",
       // v = sum over k of (2 - k/2 period) for k = 1, 2, 3
       9.0,
       {2.0 * 3.0 * -3.0, 2.0 * 9.0}},
      nested(true),
      nested(false),
      // v' = r' - v, r' = r up to 1 s, then 0.5 - r: the acceleration jumps with the function of
      // time, and with it the guard of max().
      {"a guard that jumps at a way-point",
       R"(
controllers: {c: {type: pid, input: slide/position, output: slide, gains: {p: 0.0, d: 1.0},
  setpoint: {type: waypoints, times: [0, 1, 2], positions: [0, "${r}", 0.5], interpolation: linear}}}
parameters: {r: {initial: 1, lower: 0.5, upper: 2}}
objective: {integral: [{signal: "${max(slide/acceleration, 0)}"}]})",
       0.5 * (1.0 - std::exp(-2.0)),
       {1.0 - std::exp(-2.0)}},
  };
}

class ModeChangeTest : public ::testing::TestWithParam<const char*> {};

TEST_P(ModeChangeTest, GradientsAreThoseOfClosedForms) {
  const RobotDescription robot = read_urdf({"slide.urdf", kSlide});
  for (const SwitchCase& test : switch_cases()) {
    const std::string study = "duration: 2.0\nsolver: " + std::string(GetParam()) + test.study;
    const auto system = make_system(robot, read_study({"study.yaml", study}, robot));
    EXPECT_EQ(prefers_adjoint(*system), study.find("gradient: adjoint") != std::string::npos);
    const GradientCheck check =
        check_design(system, system->parameters(), CheckMethod::kComplexStep, nullptr, {});
    ASSERT_TRUE(check.status.ok()) << test.name << ": " << describe(check.status);
    EXPECT_NEAR(check.evaluation.objective, test.objective, 1e-7) << test.name;
    for (std::size_t k = 0; k < test.gradient.size(); ++k)
      EXPECT_NEAR(check.evaluation.gradient[static_cast<Eigen::Index>(k)], test.gradient[k],
                  1e-6 * std::max(1.0, std::abs(test.gradient[k])))
          << test.name << ", parameter " << k;
    EXPECT_LT(check.largest_relative_difference, 1e-10) << test.name;
  }
}

// idas does not locate switches: other steps are taken, and the study hears of it.
TEST(ModeChange, IdasLeavesSwitchesToTheOtherIntegrator) {
  const RobotDescription robot = read_urdf({"slide.urdf", kSlide});
  for (const SwitchCase& test : switch_cases()) {
    const std::string study = std::string("duration: 2.0\nsolver: {integrator: idas, ") +
                              "relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}" +
                              test.study;
    Warnings warnings;
    const auto system = make_system(robot, read_study({"study.yaml", study}, robot), &warnings);
    ASSERT_EQ(warnings.size(), 1U) << test.name;
    EXPECT_EQ(warnings[0].code, "other_integrator") << test.name;
    const Evaluation run =
        evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
    ASSERT_TRUE(run.status.ok()) << test.name << ": " << describe(run.status);
    EXPECT_NEAR(run.objective, test.objective, 1e-7) << test.name;
    for (std::size_t k = 0; k < test.gradient.size(); ++k)
      EXPECT_NEAR(run.gradient[static_cast<Eigen::Index>(k)], test.gradient[k],
                  1e-6 * std::max(1.0, std::abs(test.gradient[k])))
          << test.name << ", parameter " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ModeChangeTest,
    ::testing::Values(
        "{relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas4, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: dopri5, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10, coordinates: "
        "absolute}",
        "{gradient: adjoint, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{gradient: adjoint, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: "
        "1.0e-10}",
        "{gradient: adjoint, method: rodas4, relative_tolerance: 1.0e-9, absolute_tolerance: "
        "1.0e-10, coordinates: absolute}",
        "{gradient: adjoint, method: dopri5, relative_tolerance: 1.0e-9, absolute_tolerance: "
        "1.0e-10, coordinates: absolute}"));

}  // namespace
}  // namespace codesign
