// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/stability_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "assembly/make_system.h"
#include "integration/mechanisms.h"
#include "integration/rosenbrock_integrator.h"

namespace codesign {
namespace {

const char* const kBothCoordinates[] = {"joint", "absolute"};

std::shared_ptr<const CompiledSystem> resting(const std::string& urdf, const std::string& study,
                                              const std::string& solver) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  return make_system(robot, read_study({"test.yaml", study + "solver: {" + solver + "}\n"}, robot));
}

/// A mass of 1 kg on a spring, at rest.
std::string spring_mass(double stiffness, double damping) {
  return robot(
      "<link name='mass'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
      "iyy='1' iyz='0' izz='1'/></inertial></link><joint name='slide' type='prismatic'>"
      "<parent link='ground'/><child link='mass'/><axis xyz='1 0 0'/><limit lower='-9' "
      "upper='9' effort='0' velocity='0'/><codesign:torsion_spring stiffness='" +
      std::to_string(stiffness) + "' damping='" + std::to_string(damping) + "'/></joint>");
}

std::string lasting(double duration, const std::string& initial_state = "{}") {
  return "duration: " + std::to_string(duration) + "\ninitial_state: " + initial_state + "\n";
}

struct Taken {
  std::int64_t steps = 0, explicit_steps = 0;
  double largest = 0.0;  ///< explicit step [s]
};

Taken take_steps(const CompiledSystem& system) {
  RosenbrockIntegrator integrator(system);
  EXPECT_TRUE(integrator.start(system.parameters()).ok());
  Taken result;
  while (integrator.state().t < system.study().duration) {
    const Status status = integrator.advance(system.study().duration);
    EXPECT_TRUE(status.ok()) << status.cause;
    if (!status.ok()) break;
    if (integrator.step().tableau().is_explicit())
      result.largest = std::max(result.largest, integrator.step().step_size());
  }
  result.steps = integrator.statistics().steps;
  result.explicit_steps = integrator.statistics().explicit_steps;
  return result;
}

// |eigenvalues| of the undamped spring and of those damped to little, to critical and beyond; the
// estimate varies with complex ones.
TEST(StabilityBound, HoldsStepsAtRestBelowTheInverseOfTheLargestEigenvalue) {
  for (const char* coordinates : kBothCoordinates)
    for (const auto& [k, d, radius] :
         {std::array{4.0, 0.0, 2.0}, std::array{1e4, 2.0, 100.0}, std::array{1e4, 140.0, 100.0},
          std::array{1e4, 200.0, 100.0}, std::array{1e4, 5000.0, 4997.9992}}) {
      const auto system = resting(spring_mass(k, d), lasting(300.0 / radius),
                                  std::string("method: dopri5, coordinates: ") + coordinates);
      const double largest = take_steps(*system).largest;
      EXPECT_LT(largest * radius, 1.6) << k << ", " << d << coordinates;
      EXPECT_GT(largest * radius, 0.5) << k << ", " << d << coordinates;
    }
}

TEST(StabilityBound, LeavesARestingStiffMechanismToTheImplicitMethod) {
  for (const char* coordinates : kBothCoordinates) {
    const Taken stiff = take_steps(*resting(spring_mass(1e8, 10.0), lasting(10.0),
                                            std::string("coordinates: ") + coordinates));
    EXPECT_LT(stiff.steps, 60) << coordinates;
    EXPECT_GT(stiff.explicit_steps, 5) << coordinates;
    EXPECT_LE(stiff.largest, 1.6e-4) << coordinates;
  }
}

// A wheel that turns evenly against its speed control rests, too: nothing in its rates changes.
TEST(StabilityBound, HoldsWhereAMechanismTurnsEvenly) {
  const std::string wheel = robot(
      "<link name='wheel'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial></link><joint name='axle' type='continuous'><parent "
      "link='ground'/><child link='wheel'/><axis xyz='0 0 1'/></joint>");
  const Taken even = take_steps(*resting(
      wheel,
      lasting(10.0, "{axle: {velocity: 3.0}}") +
          "controllers: {speed: {type: pid, input: axle/velocity, setpoint: 3.0, output: axle, "
          "gains: {p: 20}}}\n",
      "method: dopri5"));
  EXPECT_LT(even.largest, 1.6 / 20.0);
}

TEST(StabilityBound, DoesNotBindWhereNothingHasAnEigenvalue) {
  const Taken still = take_steps(*resting(spring_mass(0.0, 0.0), lasting(1e3), "method: dopri5"));
  EXPECT_LT(still.steps, 30);
}

TEST(StabilityBound, LooksAtNothingThatMoves) {
  const auto system = resting(pendulum(), lasting(3.0, "{hinge: {position: 1.0}}"), "");
  RosenbrockIntegrator integrator(*system);
  StabilityBound bound(*system);
  ASSERT_TRUE(integrator.start(system->parameters()).ok());
  bound.start();
  ASSERT_TRUE(integrator.advance(3.0).ok());
  OneStep<double>& step = integrator.step();
  ASSERT_TRUE(step.attempt(0.05));
  EXPECT_TRUE(bound.allows(&step));
  EXPECT_EQ(bound.shorten(7.0), 7.0);
  EXPECT_FALSE(bound.limits());
  // So short that it moves by less than the tolerance.
  ASSERT_TRUE(step.attempt(1e-9));
  EXPECT_TRUE(bound.allows(&step));
  const double shortened = bound.shorten(7.0);
  EXPECT_TRUE(bound.limits());
  EXPECT_NEAR(shortened, 0.9 / std::sqrt(9.81 * 0.5 / (0.0834 + 0.25)), 0.1);
}

}  // namespace
}  // namespace codesign
