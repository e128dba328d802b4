// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Commands to a run whose loads switch: a bar on a hinge without gravity, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/interactive_simulation.h"
#include "integration/servo.h"

namespace codesign {
namespace {

constexpr double kBarInertia = 0.0834 + 0.25;  // about its hinge [kg m^2]

class CommandedEvents : public testing::TestWithParam<const char*> {
 protected:
  /// @param load [N m] on the hinge.
  void start(const std::string& at, const std::string& load) {
    system_ =
        compile(pendulum(), "duration: 1.0\ngravity: [0, 0, 0]\ninitial_state: {hinge: " + at +
                                "}\nloads: [{joint: hinge, effort: \"" + load +
                                "\"}]\nobjective: {integral: [{signal: hinge/position}]}\n"
                                "solver: " +
                                GetParam() + "\n");
    run_ = std::make_unique<InteractiveSimulation>(*system_, CommandOptions(),
                                                   std::vector<SignalDescription>());
    ASSERT_TRUE(run_->start(system_->parameters()).ok());
  }
  void command(double time, double effort) {
    ASSERT_TRUE(run_->advance(time).ok());
    run_->set_effort(0, effort);
    const Status status = run_->apply(time);
    ASSERT_TRUE(status.ok()) << status.cause;
  }
  double position(double time) {
    Frame frame;
    const Status status = run_->advance(time);
    EXPECT_TRUE(status.ok()) << status.cause;
    run_->sample(time, &frame);
    return frame.joints[0].position;
  }

  std::shared_ptr<const CompiledSystem> system_;
  std::unique_ptr<InteractiveSimulation> run_;
};

TEST_P(CommandedEvents, ACommandMovesTheInstantOfAGuard) {
  start("{position: 0.0}", "${hinge/position > 0.1 ? -2.0 : 0.0}");
  const double begin = 0.2, a = 1.0 / kBarInertia, reached = begin + std::sqrt(0.2 / a),
               speed = a * (reached - begin);
  command(begin, 1.0);
  EXPECT_NEAR(position(0.4), 0.5 * a * 0.04, 1e-9);
  for (const double time : {0.6, 0.9}) {
    const double t = time - reached;
    EXPECT_NEAR(position(time), 0.1 + speed * t - 0.5 * a * t * t, 1e-8) << time;
  }
}

// The step before the command ends at the guard, which the motion after it does not reach.
TEST_P(CommandedEvents, AGuardBehindACommandIsForgotten) {
  start("{position: 0.0, velocity: 2.0}", "${hinge/position > 0.2 ? 1000.0 : 0.0}");
  command(0.09, -50.0);
  const double a = -50.0 / kBarInertia;
  for (const double time : {0.1, 0.15, 0.3}) {
    const double t = time - 0.09;
    EXPECT_NEAR(position(time), 0.18 + 2.0 * t + 0.5 * a * t * t, 1e-8) << time;
  }
}

TEST_P(CommandedEvents, ACommandAtTheInstantOfAGuard) {
  const double a = 1.5 / kBarInertia;
  start("{position: 0.0}", "${t < 0.3 ? 0.0 : 1.0}");
  command(0.3, 0.5);
  EXPECT_NEAR(position(0.8), 0.5 * a * 0.25, 1e-9);
  // At 0.3 s the position is 0.3 but for its last bits.
  start("{position: 0.0, velocity: 1.0}", "${hinge/position > 0.3 ? 1.0 : 0.0}");
  command(0.3, 0.5);
  EXPECT_NEAR(position(0.8), 0.8 + 0.5 * a * 0.25, 1e-8);
}

TEST_P(CommandedEvents, AChangeOfAParameterMovesAGuard) {
  system_ = compile(pendulum(),
                    std::string("duration: 1.0\ngravity: [0, 0, 0]\ninitial_state: {hinge: "
                                "{velocity: 1.0}}\nparameters: {edge: {initial: 0.2, lower: 0.0, "
                                "upper: 1.0}}\nloads: [{joint: hinge, effort: \"${hinge/position > "
                                "edge ? 1.0 : 0.0}\"}]\nobjective: {integral: [{signal: "
                                "hinge/position}]}\nsolver: ") +
                        GetParam() + "\n");
  InteractiveSimulation run(*system_, {}, {});
  ASSERT_TRUE(run.start({0.2}).ok());
  // Before the guard to later, and behind it to later still: the load ends and begins again.
  Frame frame;
  const double a = 1.0 / kBarInertia;
  ASSERT_TRUE(run.advance(0.1).ok());
  ASSERT_TRUE(run.change(0.1, {0.3}).ok());
  ASSERT_TRUE(run.advance(0.4).ok());
  run.sample(0.4, &frame);
  EXPECT_NEAR(frame.joints[0].position, 0.4 + 0.5 * a * 0.01, 1e-9);
  ASSERT_TRUE(run.change(0.4, {0.8}).ok());
  const double speed = 1.0 + 0.1 * a, begin = 0.4 + 0.5 * a * 0.01;
  const double reached = 0.4 + (0.8 - begin) / speed, t = 0.9 - reached;
  ASSERT_TRUE(run.advance(0.9).ok());
  run.sample(0.9, &frame);
  EXPECT_NEAR(frame.joints[0].position, 0.8 + speed * t + 0.5 * a * t * t, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    Solvers, CommandedEvents,
    testing::Values("{relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}",
                    "{coordinates: joint, relative_tolerance: 1.0e-10, absolute_tolerance: "
                    "1.0e-11}",
                    "{coordinates: joint, method: rodas5p, relative_tolerance: 1.0e-10, "
                    "absolute_tolerance: 1.0e-11}"));

}  // namespace
}  // namespace codesign
