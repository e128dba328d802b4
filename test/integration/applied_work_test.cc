// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/applied_work.h"

#include <gtest/gtest.h>

#include "integration/energy_balance.h"
#include "integration/servo.h"

namespace codesign {
namespace {

std::shared_ptr<const CompiledSystem> swinging(const std::string& urdf, const std::string& initial, const std::string& signal,
                                               const std::string& solver) {
  return compile(urdf, motion_study(1.0, initial, signal, solver));
}

std::string tight(const std::string& coordinates) {
  std::string solver = kTight;
  return solver.insert(solver.find('{') + 1, "coordinates: " + coordinates + ", ");
}

const char* const kThrown = "{shoulder: {position: 0.7, velocity: 2.0}, elbow: {velocity: -1.0}}";

/// A run at its start, and the motion of its bodies.
struct Started {
  Started(const std::string& urdf, const std::string& initial, const std::string& signal, const std::string& coordinates)
      : system(swinging(urdf, initial, signal, tight(coordinates))), integrator(*system), motion(*system) {
    EXPECT_TRUE(integrator.start({}).ok());
    motion.set_design(integrator.equations());
  }

  std::shared_ptr<const CompiledSystem> system;
  RosenbrockIntegrator integrator;
  BodyMotion motion;
};

TEST(BodyMotion, EnergyIsThatOfTheState) {
  for (const char* coordinates : {"absolute", "joint"}) {
    Started run(double_pendulum(), kThrown, "elbow/velocity", coordinates);
    RosenbrockIntegrator& integrator = run.integrator;
    const BodyEnergy energy = run.motion.energy(integrator.state().q, integrator.state().v);
    integrator.equations().formulas().load(integrator.state());
    const Energy expected = mechanical_energy(integrator.equations());
    EXPECT_NEAR(energy.kinetic, expected.kinetic, 1e-13) << coordinates;
    EXPECT_NEAR(energy.potential, expected.potential, 1e-13) << coordinates;
  }
}

TEST(BodyMotion, SpeedsAndDistancesAreTheSameInBothCoordinates) {
  const auto measured = [](const char* coordinates) {
    const Started run(double_pendulum(), kThrown, "elbow/velocity", coordinates);
    const State<double>& state = run.integrator.state();
    run.motion.move(state.q, state.v);
    Eigen::VectorXd numbers(6);
    for (int body = 0; body < 2; ++body) {
      const auto [linear, angular] = run.motion.speed(body, state.v);
      numbers.segment<3>(3 * Eigen::Index{body}) << run.motion.distance(body, state.q), linear, angular;
    }
    return numbers;
  };
  const Eigen::VectorXd joint = measured("joint");
  EXPECT_LT((joint - measured("absolute")).norm(), 1e-12);
  EXPECT_GT(joint.minCoeff(), 0.4);
}

// Without springs and friction nothing but gravity has power; a damper of 0.5 N m s at 3 rad/s takes 4.5 W.
TEST(BodyMotion, PowerIsThatOfEverythingButGravity) {
  for (const char* coordinates : {"absolute", "joint"})
    for (double damping : {0.0, 0.5}) {
      const Started run(pendulum("<dynamics damping='" + std::to_string(damping) + "'/>"), "{hinge: {position: 0.7, velocity: 3.0}}",
                        "hinge/velocity", coordinates);
      const State<double>& state = run.integrator.state();
      EXPECT_NEAR(run.motion.power(state.q, state.v, state.z), -damping * 9.0, 1e-11) << coordinates;
    }
}

// The work of friction, by Gauss quadrature of the power that the friction law reports.
TEST(StepWork, OfFrictionIsWhatTheLawTakes) {
  for (const char* method : {"rodas4", "rodas4p2", "rodas5p", "dopri5"}) {
    const std::string solver =
        std::string("{integrator: rosenbrock, method: ") + method + ", relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}";
    const std::string urdf = double_pendulum(pin_friction()),
                      study = motion_study(1.0, "{shoulder: {position: 1.5}}", "elbow/velocity", solver);
    const Balance expected = balance(urdf, study);
    const auto system = compile(urdf, study);
    RosenbrockIntegrator integrator(*system);
    ASSERT_TRUE(integrator.start({}).ok());
    BodyMotion motion(*system);
    motion.set_design(integrator.equations());
    StepWork steps(*system);
    steps.start(integrator.state(), motion);
    double work = 0.0;
    while (integrator.state().t < 1.0) {
      ASSERT_TRUE(integrator.advance(1.0).ok());
      work += steps.over(integrator.step(), motion);
    }
    EXPECT_GT(expected.friction_work, 0.1);
    EXPECT_NEAR(-work, expected.friction_work, 1e-5 * expected.friction_work) << method;
  }
}

}  // namespace
}  // namespace codesign
