// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The paper's model mismatch: gains tuned with and without friction, used without friction and on a
// surface with another friction law.
#include <cmath>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

using Gains = std::vector<double>;
/// The optima that test/cases/inverted_pendulum_test.cc finds: under Brown and McPhee's friction
/// (0.4, 0.3), and without.
const Gains kWith = {546.115, 623.979, 90.071}, kWithout = {427.73, 1.11, 65.22};

struct Motion {
  std::vector<double> error,
      force;  ///< magnitudes of the error and the force of both controllers, at eleven instants
};

Motion run(const Shipped& shipped, const Gains& gains) {
  std::vector<SignalDescription> signals;
  for (const char* name : {"servo_x/error", "servo_y/error", "servo_x/output", "servo_y/output"})
    signals.push_back(parse_signal(name, {"test", 0}, "signal"));
  Simulation simulation = simulation_of(make_system(shipped.robot, shipped.study), gains, signals);
  Motion result;
  const Status status = simulate(&simulation, shipped.study.duration, 11, [&](const Frame& frame) {
    result.error.push_back(std::hypot(frame.signals[0], frame.signals[1]));
    result.force.push_back(std::hypot(frame.signals[2], frame.signals[3]));
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return result;
}

TEST(ModelMismatch, GainsTunedWithoutFrictionLeaveALastingOffsetOnTheRoughSurface) {
  const Shipped smooth("inverted_pendulum_frictionless"),
      rough("inverted_pendulum", "inverted_pendulum_gonthier");
  ASSERT_EQ(rough.robot.joints[0].friction->model, FrictionModel::kGonthier);
  // Without friction, the gains tuned without friction keep_pivots sooner and need less force.
  const Motion smooth_with = run(smooth, kWith), smooth_without = run(smooth, kWithout);
  EXPECT_LT(smooth_without.error[5], 0.2 * smooth_with.error[5]);
  EXPECT_LT(smooth_without.force[0], 0.8 * smooth_with.force[0]);
  // On the rough surface they leave an offset of 9 cm, the others 1 mm.
  const Motion rough_with = run(rough, kWith), rough_without = run(rough, kWithout);
  EXPECT_LT(rough_with.error.back(), 0.002);
  EXPECT_NEAR(rough_without.error.back(), 0.0874, 0.001);
  EXPECT_NEAR(rough_without.error[5], rough_without.error.back(), 0.001);
}

// Steady motion: friction mu_d N against the plate, the rod tilted by e, so that both accelerate at
// g e/L: Kp e = mu_d N + m g e/L.
TEST(ModelMismatch, TheOffsetIsTheOneThatStaticsDemands) {
  const double mass = 7.2, height = 0.665, load = 0.4 * mass * 9.81;
  const Motion rough = run(Shipped("inverted_pendulum", "inverted_pendulum_gonthier"), kWithout);
  EXPECT_NEAR(rough.error.back(), load / (kWithout[0] - mass * 9.81 / height), 0.002);
}

TEST(ModelMismatch, TheRoughSurfaceHasAGradientToo) {
  Shipped rough("inverted_pendulum", "inverted_pendulum_gonthier");
  rough.study.solver.relative_tolerance = 1e-7;
  rough.study.solver.absolute_tolerance = 1e-8;
  const GradientCheck check = check_gradient(make_system(rough.robot, rough.study), rough.start(),
                                             CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-8);
}

}  // namespace
}  // namespace codesign
