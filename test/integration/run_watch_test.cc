// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "equations/formulas.h"
#include "integration/driven_slides.h"
#include "integration/energy_balance.h"
#include "integration/linkages.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/run_watch.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

std::shared_ptr<const CompiledSystem> swinging(const std::string& urdf, const std::string& initial,
                                               const std::string& signal,
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
  Started(const std::string& urdf, const std::string& initial, const std::string& signal,
          const std::string& coordinates)
      : system(swinging(urdf, initial, signal, tight(coordinates))),
        integrator(*system),
        motion(*system) {
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
      numbers.segment<3>(3 * Eigen::Index{body}) << run.motion.distance(body, state.q), linear,
          angular;
    }
    return numbers;
  };
  const Eigen::VectorXd joint = measured("joint");
  EXPECT_LT((joint - measured("absolute")).norm(), 1e-12);
  EXPECT_GT(joint.minCoeff(), 0.4);
}

// Without springs and friction nothing but gravity has power; a damper of 0.5 N m s at 3 rad/s
// takes 4.5 W.
TEST(BodyMotion, PowerIsThatOfEverythingButGravity) {
  for (const char* coordinates : {"absolute", "joint"})
    for (double damping : {0.0, 0.5}) {
      const Started run(pendulum("<dynamics damping='" + std::to_string(damping) + "'/>"),
                        "{hinge: {position: 0.7, velocity: 3.0}}", "hinge/velocity", coordinates);
      const State<double>& state = run.integrator.state();
      EXPECT_NEAR(run.motion.power(state.q, state.v, state.z), -damping * 9.0, 1e-11)
          << coordinates;
    }
}

// The work of friction, by Gauss quadrature of the power that the friction law reports.
TEST(StepWork, OfFrictionIsWhatTheLawTakes) {
  for (const char* method : {"rodas4", "rodas4p2", "rodas5p", "dopri5"}) {
    const std::string solver = std::string("{integrator: rosenbrock, method: ") + method +
                               ", relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}";
    const std::string urdf = double_pendulum(pin_friction()),
                      study = motion_study(1.0, "{shoulder: {position: 1.5}}", "elbow/velocity",
                                           solver);
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

std::string solver(const std::string& integrator, double tolerance) {
  const std::string relative = std::to_string(tolerance * 1e10) + "e-10",
                    absolute = std::to_string(tolerance * 1e10) + "e-11";
  return "{integrator: " + integrator + ", relative_tolerance: " + relative +
         ", absolute_tolerance: " + absolute + "}";
}

/// A pendulum at its start, and a watch over it.
class WatchedPendulum : public ::testing::Test {
 protected:
  WatchedPendulum()
      : system_(compile(pendulum(), motion_study(1.0, "{hinge: {position: 1.0, velocity: 2.0}}",
                                                 "hinge/velocity", solver("rosenbrock", 1e-6)))),
        integrator_(*system_),
        watch_(*system_) {
    EXPECT_TRUE(integrator_.start({}).ok());
    watch_.start(integrator_.equations(), integrator_.state());
    state_ = integrator_.state();
  }

  std::shared_ptr<const CompiledSystem> system_;
  RosenbrockIntegrator integrator_;
  RunWatch watch_;
  State<double> state_;
  Statistics statistics_;
};

TEST(RunLimits, WarnBeforeTheyFailAndNeverForbidWhatATolleranceAllows) {
  for (double tolerance = 1e-12; tolerance < 0.02; tolerance *= 10.0) {
    EXPECT_LT(drift_limit(tolerance).warning, drift_limit(tolerance).failure);
    EXPECT_LT(energy_limit(tolerance).warning, energy_limit(tolerance).failure);
    EXPECT_GE(energy_limit(tolerance).warning, 10.0 * tolerance);
  }
  EXPECT_DOUBLE_EQ(energy_limit(1e-6).warning, 1e-3);
  EXPECT_DOUBLE_EQ(energy_limit(1e-6).failure, 1e-2);
  EXPECT_DOUBLE_EQ(drift_limit(1e-6).warning, 1e4);
}

TEST_F(WatchedPendulum, DriftIsTheLargestCorrectionInUnitsOfItsTolerance) {
  VectorX<double> positions = VectorX<double>::Zero(7), velocities = positions;
  EXPECT_EQ(watch_.drift(state_, positions, velocities), 0.0);
  positions[1] = 3e-7;  // y stays zero: the absolute tolerance, 1e-7
  EXPECT_NEAR(watch_.drift(state_, positions, velocities), 3.0, 1e-9);
  velocities[0] = -1e-4;
  EXPECT_NEAR(watch_.drift(state_, positions, velocities),
              1e-4 / (1e-7 + 1e-6 * std::abs(state_.v[0])), 1e-6);
}

TEST_F(WatchedPendulum, DriftWarnsAndThenFails) {
  EXPECT_TRUE(watch_.check(state_, 5.0, 0.0, &statistics_).ok());
  EXPECT_TRUE(watch_.warnings(statistics_).empty());
  state_.t = 0.25;
  EXPECT_TRUE(watch_.check(state_, 2e4, 0.0, &statistics_).ok());
  EXPECT_EQ(statistics_.constraint_drift, 2e4);
  ASSERT_EQ(watch_.warnings(statistics_).size(), 1u);
  EXPECT_EQ(watch_.warnings(statistics_)[0].code, "constraint_drift");
  EXPECT_NE(watch_.warnings(statistics_)[0].message.find("t = 0.25 s"), std::string::npos);
  const Status status = watch_.check(state_, 2e5, 0.0, &statistics_);
  EXPECT_EQ(status.code, StatusCode::kConstraintDrift);
  EXPECT_EQ(status.time, 0.25);
}

TEST_F(WatchedPendulum, WorkDoneBalancesTheEnergy) {
  const double kinetic = watch_.motion().energy(state_.q, state_.v).kinetic;
  state_.v *= std::sqrt(2.0);
  EXPECT_TRUE(watch_.check(state_, 0.0, kinetic, &statistics_).ok());
  EXPECT_NEAR(statistics_.energy_error, 0.0, 1e-15);
}

TEST_F(WatchedPendulum, EnergyFromNowhereWarnsAndFailsIfItStays) {
  state_.v *= std::sqrt(1.004);
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(watch_.check(state_, 0.0, 0.0, &statistics_).ok());
  EXPECT_NEAR(statistics_.energy_error, 0.004, 1e-4);
  ASSERT_EQ(watch_.warnings(statistics_).size(), 1u);
  EXPECT_EQ(watch_.warnings(statistics_)[0].code, "energy_error");
  state_.v *= std::sqrt(1.5);
  Status status;
  int steps = 0;
  for (; status.ok() && steps < 100; ++steps) status = watch_.check(state_, 0.0, 0.0, &statistics_);
  EXPECT_EQ(status.code, StatusCode::kEnergyError) << status.cause;
  EXPECT_GT(steps, 1) << "the first steps from rest may be wrong by all there is";
}

TEST_F(WatchedPendulum, EnergyFromNowhereAtTheEndFailsAtOnce) {
  state_.v *= 1.5;
  state_.t = 1.0;
  EXPECT_EQ(watch_.check(state_, 0.0, 0.0, &statistics_).code, StatusCode::kEnergyError);
}

TEST_F(WatchedPendulum, EnergyFromNowhereAtAnEndOfItsOwnFailsAtOnce) {
  state_.v *= 1.5;
  state_.t = 0.6;
  EXPECT_TRUE(watch_.check(state_, 0.0, 0.0, &statistics_).ok());
  watch_.end_at(0.6);
  EXPECT_EQ(watch_.check(state_, 0.0, 0.0, &statistics_).code, StatusCode::kEnergyError);
}

// 0.007 of the energy are lost before a change and as much behind it, together more than the limit.
TEST_F(WatchedPendulum, ABalanceEndsAtAChangeOnceItCouldHaveFailed) {
  const auto lose = [&](double part, int steps) {
    state_.v *= std::sqrt(part);
    for (int k = 0; k < steps; ++k) EXPECT_TRUE(watch_.check(state_, 0.0, 0.0, &statistics_).ok());
  };
  const double energy = watch_.motion().energy(state_.q, state_.v).kinetic;
  lose(0.993, 30);
  EXPECT_NEAR(statistics_.energy_error, 0.007, 1e-5);
  watch_.go_on(integrator_.equations(), state_);
  lose(0.993, 30);
  EXPECT_NEAR(statistics_.energy_error, 0.007, 1e-5) << "of the larger one";
  lose(0.993, 5);
  EXPECT_GT(statistics_.energy_error, 0.012) << "within one balance errors add up";
  watch_.go_on(integrator_.equations(), state_);
  const double kept = statistics_.energy_error;
  lose(1.0, 5);
  EXPECT_EQ(statistics_.energy_error, kept);
  watch_.go_on(integrator_.equations(), state_);  // too short to be closed
  lose(1.0 - 0.02 * energy / watch_.motion().energy(state_.q, state_.v).kinetic, 1);
  EXPECT_NEAR(statistics_.energy_error, 0.02, 1e-4);
}

// The mechanism rests; its computed motion is only rounding.
TEST(RunWatch, WhatHangsAtRestIsNotMeasuredByItsRounding) {
  const auto system = compile(
      pendulum(),
      motion_study(2.0, "{hinge: {position: 0.0}}", "hinge/velocity", solver("rosenbrock", 1e-10)));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({}).ok());
  while (integrator.state().t < 2.0) ASSERT_TRUE(integrator.advance(2.0).ok());
  EXPECT_LT(integrator.statistics().energy_error, 1e-6);
  EXPECT_TRUE(integrator.warnings().empty());
}

// Two stiff springs hold a slide, without gravity; its vibration is less than the tolerances
// resolve.
TEST(RunWatch, WhatSpringsHoldAtRestHasNoEnergyToBeChecked) {
  const auto spring = [](const std::string& name, const std::string& at,
                         const std::string& length) {
    return "<codesign:spring_damper name='" + name +
           "' stiffness='1000000' damping='1000' free_length='" + length +
           "'><predecessor link='ground'><origin xyz='" + at +
           " 0 0'/></predecessor><successor link='bar'/></codesign:spring_damper>";
  };
  const std::string slide = robot(bar("bar") +
                                  "<joint name='slide' type='prismatic'><parent "
                                  "link='ground'/><child link='bar'/><axis xyz='1 0 0'/>"
                                  "<limit effort='1' velocity='1'/></joint>" +
                                  spring("left", "-1", "0.5") + spring("right", "1", "0.5000001"));
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const auto system =
        compile(slide, motion_study(1.0, "{}", "slide/velocity", solver(integrator, 1e-6)) +
                           "gravity: [0, 0, 0]\n");
    Simulation simulation = simulation_of(system, system->parameters());
    Status status = simulation.start();
    if (status.ok()) status = simulation.advance(1.0);
    EXPECT_TRUE(status.ok()) << integrator << ": " << status.cause;
    EXPECT_TRUE(simulation.warnings().empty())
        << integrator << ": " << simulation.statistics().energy_error;
  }
}

double angle(const State<double>& state) { return 2.0 * std::atan2(state.q[5], state.q[3]); }

/// theta of upright_row(), which starts upright.
double upright_angle(int count, double rate, double t) {
  return reference_angle([count](double x) { return upright_row_acceleration(count, x); }, 0.0,
                         rate, t, 40000);
}

// IFToMM A02: ten seconds take it past its flat position a dozen times. `idas` used to leave the
// branch, with half as much energy again.
TEST(RunWatch, ADoubleParallelogramKeepsToItsBranchOrSaysThatItDoesNot) {
  const double end = upright_angle(2, 1.0, 10.0);
  for (const char* integrator : {"rosenbrock", "idas"}) {
    for (double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const auto system =
          compile(upright_row(2), motion_study(10.0, "{hinge0: {position: 0.0, velocity: 1.0}}",
                                               "hinge0/velocity", solver(integrator, tolerance)));
      const auto run = make_integrator(*system);
      Status status = run->start({});
      while (status.ok() && run->state().t < 10.0) status = run->advance(10.0);
      ASSERT_TRUE(status.ok() || tolerance > 1e-5)
          << integrator << " at " << tolerance << ": " << status.cause;
      if (!status.ok()) {
        EXPECT_TRUE(status.code == StatusCode::kEnergyError ||
                    status.code == StatusCode::kConstraintDrift)
            << status.cause;
        continue;
      }
      EXPECT_NEAR(std::sin(0.5 * (angle(run->state()) - end)), 0.0, 3e3 * tolerance)
          << integrator << " at " << tolerance;
      EXPECT_TRUE(run->warnings().empty()) << run->warnings()[0].message;
      EXPECT_GT(run->statistics().constraint_drift, 0.0);
      EXPECT_GT(run->statistics().energy_error, 0.0);
    }
  }
}

// With a tight absolute tolerance nearly every step is a restart there, with ever shorter steps:
// 200,000 of them took minutes.
TEST(RunWatch, IdasThatStandsStillAtAFlatPositionSaysSo) {
  const std::string solver =
      "{integrator: idas, relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-11}";
  const auto system = compile(
      upright_row(2),
      motion_study(10.0, "{hinge0: {position: 0.0, velocity: 1.0}}", "hinge0/velocity", solver));
  const auto run = make_integrator(*system);
  Status status = run->start({});
  while (status.ok() && run->state().t < 10.0) status = run->advance(10.0);
  EXPECT_TRUE(status.code == StatusCode::kStepSizeTooSmall ||
              status.code == StatusCode::kSingularConfiguration)
      << status.cause;
  EXPECT_NEAR(status.time, 0.714, 0.001);
  EXPECT_LT(run->statistics().steps, 10000);
}

// IFToMM A04, at the tolerances at which `idas` used to stop at the first step, or never.
TEST(RunWatch, ABricardRingIsRightByBothIntegratorsOrSaysThatItIsNot) {
  State<double> reference;
  for (const char* integrator : {"rosenbrock", "idas"}) {
    for (double tolerance : {1e-9, 1e-8, 1e-7, 1e-6}) {
      const auto system =
          compile(bricard(), motion_study(2.0, bricard_start(1.2, 0.7), "turn1/velocity",
                                          solver(integrator, tolerance)));
      const auto run = make_integrator(*system);
      Status status = run->start({});
      while (status.ok() && run->state().t < 2.0) status = run->advance(2.0);
      ASSERT_TRUE(status.ok()) << integrator << " at " << tolerance << ": " << status.cause;
      if (reference.q.size() == 0) reference = run->state();
      EXPECT_LT((run->state().q - reference.q).cwiseAbs().maxCoeff(), 1e4 * tolerance)
          << integrator << " at " << tolerance;
    }
  }
}

// Gravity along the hinges: the redundant ring gives way by its compliance, less than the absolute
// tolerance resolves.
TEST(RunWatch, AMechanismThatHardlyMovesIsNotJudgedByWhatNoToleranceResolves) {
  const std::string text = motion_study(2.0, "{left_hinge: {position: 0.3}}", "left_hinge/velocity",
                                        solver("rosenbrock", 1e-6));
  const auto system = compile(four_bar(), text + "gravity: [0, -9.81, 0]\n");
  Simulation simulation = simulation_of(system, system->parameters());
  Status status = simulation.start();
  if (status.ok()) status = simulation.advance(2.0);
  EXPECT_TRUE(status.ok()) << status.cause;
  EXPECT_TRUE(simulation.warnings().empty()) << simulation.statistics().energy_error;
}

// Steps under such a force have no error, so that they are as long as the run.
TEST(RunWatch, AForceThatIsAPolynomialOfTheTimeIsInBalance) {
  for (const char* method : {"auto", "rodas5p"}) {
    const auto system =
        compile(robot(mass("block", 2.0) + lift("slide", "block", 0.0)),
                std::string("duration: 2.0\nloads: [{joint: slide, effort: \"${5*(t - 1)**2}\"}]\n"
                            "objective: {terminal: [{signal: slide/position}]}\n"
                            "solver: {method: ") +
                    method + "}\n");
    Simulation simulation = simulation_of(system, system->parameters());
    Status status = simulation.start();
    if (status.ok()) status = simulation.advance(2.0);
    EXPECT_TRUE(status.ok()) << method << ": " << status.cause;
    EXPECT_LT(simulation.statistics().energy_error, 1e-6) << method;
  }
}

}  // namespace

}  // namespace codesign
