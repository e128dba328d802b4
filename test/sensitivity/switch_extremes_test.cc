// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Extreme values of watched signals at instants that guards determine, theory (21d'), against
// closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// A mass that slides along x.
constexpr const char* kMass = R"(<robot name="cart" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="mass" value="1" lower="0.1" upper="10"/>
  <link name="ground"/>
  <link name="body"><inertial><mass value="1" codesign:value="${mass}"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/>
    <axis xyz="1 0 0"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
</robot>)";

struct ExtremeCase {
  const char* name;
  std::string study;
  double objective;
  std::vector<double> gradient;
  bool has_band = false;
};

/// The velocity rises by 3 N until `ts` and falls by 1 N afterwards.
std::string pushed(const char* ts, const char* objective) {
  return std::string(R"(
loads: [{joint: slide, effort: "${t < ts ? 3 : -1}"}]
parameters: {ts: {initial: )") +
         ts + ", lower: 0.1, upper: 1.9}}\nobjective: " + objective;
}

std::vector<ExtremeCase> kinks() {
  const double v = std::sqrt(1.0 + 2.0 * 0.45);
  return {
      {"a largest velocity", pushed("0.8", "{maximum: [{signal: slide/velocity}]}"), 2.4, {3.0}},
      // The instants between windows are multiples of an eighth of a second.
      {"a largest velocity between two windows",
       pushed("1.0", "{maximum: [{signal: slide/velocity}]}"),
       3.0,
       {3.0}},
      {"a smallest velocity between two windows",
       pushed("1.0", "{minimum: [{signal: \"${-slide/velocity}\"}]}"),
       -3.0,
       {-3.0}},
      {"a stroke", pushed("0.8", "{stroke: [{signal: slide/velocity}]}"), 2.4, {3.0}},
      {"a stroke between two windows",
       pushed("1.0", "{stroke: [{signal: slide/velocity}]}"),
       3.0,
       {3.0}},
      {"a peak", pushed("0.8", "{peak: [{signal: slide/velocity, weight: 2}]}"), 4.8, {6.0}},
      // v^2 = v0^2 + 2 xs / m at xs.
      {"a threshold of a position",
       R"(
initial_state: {slide: {velocity: "${v0}"}}
loads: [{joint: slide, effort: "${slide/position > xs ? -1 : 1}"}]
parameters: {xs: {initial: 0.45, lower: 0.1, upper: 1.5}, v0: {initial: 1, lower: 0.5, upper: 2},
  mass: {}}
objective: {maximum: [{signal: slide/velocity}]})",
       v,
       {1.0 / v, 1.0 / v, -0.45 / v}},
  };
}

std::vector<ExtremeCase> jumps() {
  return {
      // The acceleration is largest just before the switch.
      {"a jump downwards",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 2*t : -1}"}]
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {maximum: [{signal: slide/acceleration}]})",
       1.6,
       {2.0}},
      // The same at an instant between two of the windows in which extreme values are sought.
      {"a jump downwards between two windows",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 2*t : -1}"}]
parameters: {ts: {initial: 1.0, lower: 0.1, upper: 1.9}}
objective: {maximum: [{signal: slide/acceleration}]})",
       2.0,
       {2.0}},
      // And just behind it.
      {"a jump upwards",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 0 : 3 - t}"}]
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {maximum: [{signal: slide/acceleration}]})",
       2.2,
       {-1.0}},
      {"a jump upwards between two windows",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 0 : 3 - t}"}]
parameters: {ts: {initial: 1, lower: 0.1, upper: 1.9}}
objective: {maximum: [{signal: slide/acceleration}]})",
       2.0,
       {-1.0}},
      // The acceleration is within the band until the switch.
      {"a dwell that a jump ends",
       R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 0.8, lower: 0.1, upper: 1.9}}
objective: {dwell: [{signal: slide/acceleration, band: [0.5, 1.5]}]})",
       0.8,
       {1.0},
       true},
  };
}

/// Switches of the watched expressions themselves, which no load has.
std::vector<ExtremeCase> own_switches() {
  const std::string moves = R"(
initial_state: {slide: {velocity: "${v0}"}}
parameters: {xs: {initial: 0.45, lower: 0.1, upper: 1.5}, v0: {initial: 1, lower: 0.5, upper: 2}}
)";
  return {
      {"a kink of the signal",
       moves +
           "objective: {maximum: [{signal: \"${min(slide/position, 2*xs - slide/position)}\"}]}",
       0.45,
       {1.0, 0.0}},
      // It jumps to 3 - t at t = xs/v0.
      {"a jump of the signal",
       moves + "objective: {maximum: [{signal: \"${slide/position > xs ? 3 - t : 0}\"}]}",
       2.55,
       {-1.0, 0.45}},
      // v t - 2 |t - xs|, which rises up to xs.
      {"a kink of the reference",
       moves + "objective: {maximum: [{signal: slide/position, reference: \"${2*abs(t - xs)}\"}]}",
       0.45,
       {1.0, 0.45}},
  };
}

class SwitchExtremesTest : public ::testing::TestWithParam<const char*> {
 protected:
  static void expect(const std::vector<ExtremeCase>& cases) {
    const RobotDescription robot = read_urdf({"slide.urdf", kMass});
    for (const ExtremeCase& test : cases) {
      const std::string study = "duration: 2.0\nsolver: " + std::string(GetParam()) + test.study;
      const auto system = make_system(robot, read_study({"study.yaml", study}, robot));
      const GradientCheck check =
          check_design(system, system->parameters(), CheckMethod::kComplexStep, nullptr, {});
      ASSERT_TRUE(check.status.ok()) << test.name << ": " << describe(check.status);
      EXPECT_NEAR(check.evaluation.objective, test.objective, 1e-7) << test.name;
      ASSERT_EQ(check.evaluation.gradient.size(), static_cast<Eigen::Index>(test.gradient.size()));
      for (std::size_t k = 0; k < test.gradient.size(); ++k)
        EXPECT_NEAR(check.evaluation.gradient[static_cast<Eigen::Index>(k)], test.gradient[k], 1e-6)
            << test.name << ", parameter " << k;
      EXPECT_TRUE(test.has_band || check.largest_relative_difference < 1e-10) << test.name;
    }
  }
};

TEST_P(SwitchExtremesTest, MoveWithAKink) { expect(kinks()); }
TEST_P(SwitchExtremesTest, MoveWithAJump) { expect(jumps()); }
TEST_P(SwitchExtremesTest, OfExpressionsThatSwitch) { expect(own_switches()); }

INSTANTIATE_TEST_SUITE_P(
    Methods, SwitchExtremesTest,
    ::testing::Values(
        "{relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas4, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}",
        "{method: dopri5, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10, coordinates: "
        "absolute}"));

/// The numbers of a bound along the whole run, with their derivatives by `ts`.
Evaluation bounded(const char* ts, const char* load) {
  const RobotDescription robot = read_urdf({"slide.urdf", kMass});
  const std::string study = std::string("duration: 2.0\nloads: [{joint: slide, effort: \"${") +
                            load + "}\"}]\nparameters: {ts: {initial: " + ts +
                            ", lower: 0.1, upper: 1.9}}\npath: [{signal: slide/velocity, at_most: "
                            "9}]\nobjective: {terminal: [{signal: slide/position}]}";
  const auto system = make_system(robot, read_study({"study.yaml", study}, robot));
  return evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
}

// A kink at which the velocity goes on rising is no extremum: the value between both windows is
// that of a fixed time.
TEST(SwitchExtremes, DoNotMoveWhereTheSignalDoesNotTurn) {
  const Evaluation run = bounded("1.0", "t < ts ? 3 : 1");
  ASSERT_TRUE(run.status.ok()) << describe(run.status);
  for (Eigen::Index k = 0; k < run.extremes.values.size(); ++k) {
    // v(t) = 3 t up to ts, then 3 ts + t - ts: by ts it is 0 before 1 s, and 2 behind it; at 1 s
    // one of both.
    const double time = run.extremes.times[k], by = run.extremes.gradients(0, k);
    const bool is_between = std::abs(time - 1.0) < 1e-6;
    EXPECT_NEAR(by, (is_between ? by > 1.0 : time > 1.0) ? 2.0 : 0.0, 1e-6) << time;
  }
}

TEST(SwitchExtremes, MoveInBothWindowsWhereTheSignalTurns) {
  const Evaluation run = bounded("1.0", "t < ts ? 3 : -1");
  ASSERT_TRUE(run.status.ok()) << describe(run.status);
  int found = 0;
  for (Eigen::Index k = 0; k < run.extremes.values.size(); ++k)
    if (std::abs(run.extremes.values[k] - 3.0) < 1e-9 &&
        std::abs(run.extremes.gradients(0, k) - 3.0) < 1e-6)
      ++found;
  EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace codesign
