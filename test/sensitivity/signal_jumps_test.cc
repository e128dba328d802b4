// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Signals that jump at many break times.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "assembly/make_system.h"
#include "integration/mechanisms.h"
#include "integration/watch_layout.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr int kBreaks = 500;

double height(int k) { return k % 2 == 0 ? 0.0 : 1.0 + 0.5 * std::sin(0.05 * k); }

/// A bar without gravity that hardly moves: its controller's output is p r + d r', a saw whose
/// teeth have the heights of r. Where r turns it jumps, with d > 0 down from its largest value,
/// with d < 0 up to it.
std::shared_ptr<const CompiledSystem> saw(const std::string& integrator, double d) {
  const RobotDescription robot = read_urdf({"test.urdf", pendulum()});
  std::string times = "0.0", positions = "0.0";
  for (int k = 1; k <= kBreaks; ++k) {
    times += ", " + std::to_string(k / static_cast<double>(kBreaks));
    positions += ", \"${" + std::to_string(height(k)) + "*h}\"";
  }
  const std::string study =
      "duration: 1.0\ngravity: [0.0, 0.0, 0.0]\ninitial_state: {hinge: {velocity: "
      "1.0e-3}}\ncontrollers: {hold: {type: pid, input: "
      "hinge/position, output: hinge, "
      "gains: {p: \"${Kp}\", d: \"${Kd}\"}, setpoint: {type: waypoints, interpolation: linear, "
      "times: [" +
      times + "], positions: [" + positions +
      "]}}}\nparameters: {Kp: {initial: 1.0e-3}, Kd: {initial: " + std::to_string(d) +
      "}, h: {initial: 1.0}}\n"
      "objective: {terminal: [{signal: hinge/position}]}\npath: [{signal: hold/output, at_most: "
      "1.0}]\n"
      "solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-12, integrator: " +
      integrator + "}\n";
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

class SignalJumpsTest : public ::testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(SignalJumpsTest, ValuesBeforeAndBehindThemCount) {
  const auto [integrator, d] = GetParam();
  const auto system = saw(integrator, d);
  const std::vector<double> design = system->parameters();
  const Evaluation evaluation = evaluator_of(system).evaluate_design(design, true);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  const Extremes& extremes = evaluation.extremes;
  const WatchLayout::Entry entry = WatchLayout(system->study()).entries()[0];
  ASSERT_EQ(entry.windows(), 16) << "the break times are within windows";
  for (int window = 0; window < entry.windows(); ++window) {
    const double from = entry.instants[static_cast<std::size_t>(window)],
                 to = entry.instants[static_cast<std::size_t>(window) + 1];
    double largest = 0.0, smallest = 1.0;
    for (int k = 1; k <= kBreaks; ++k) {
      const double time = k / static_cast<double>(kBreaks);
      const double before = 1e-3 * height(k) + d * kBreaks * (height(k) - height(k - 1));
      const double behind = 1e-3 * height(k) + d * kBreaks * (height(k + 1) - height(k));
      for (const auto& [value, counts] : {std::make_pair(before, time > from && time <= to),
                                          {behind, k < kBreaks && time >= from && time <= to}})
        if (counts) {
          largest = std::max(largest, value);
          smallest = std::min(smallest, value);
        }
    }
    // The bar moves by less than 3e-3 rad.
    EXPECT_NEAR(extremes.values[entry.largest(window)], largest, 5e-6) << "window " << window;
    EXPECT_NEAR(extremes.values[entry.smallest(window)], smallest, 5e-6) << "window " << window;
  }
}

TEST(SignalJumps, DerivativesBeforeThemMeetTheComplexStep) {
  const auto system = saw("rosenbrock", 1e-6);
  const GradientCheck check =
      check_gradient(system, Eigen::Vector3d(1e-3, 1e-6, 1.0), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-8);
  EXPECT_GT(check.evaluation.extremes.gradients.row(2).maxCoeff(), 1e-3)
      << "the peaks grow with the height of the saw";
}

INSTANTIATE_TEST_SUITE_P(Integrators, SignalJumpsTest,
                         ::testing::Values(std::make_pair("rosenbrock", 1e-6),
                                           std::make_pair("rosenbrock", -1e-6),
                                           std::make_pair("idas", 1e-6)));

}  // namespace
}  // namespace codesign
