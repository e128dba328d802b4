// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <limits>

#include "description/study.h"
#include "equations/equations.h"
#include "integration/integrator.h"
#include "integration/servo.h"
#include "integration/step_control.h"

namespace codesign {
namespace {

/// The next step after one of size 1 with this error, by a fresh controller of order 4.
double after(double error) {
  double proposal = 0.0;
  StepController(4).accept(1.0, error, &proposal);
  return proposal;
}

TEST(StepController, AcceptsUpToOne) {
  double proposal = 0.0;
  EXPECT_TRUE(StepController(4).accept(1.0, 1.0, &proposal));
  EXPECT_FALSE(StepController(4).accept(1.0, 1.0 + 1e-15, &proposal));
}

TEST(StepController, TheNextStepWouldMeetTheToleranceWithASafetyOfATenth) {
  // The error of a method of order 4 goes with h^4.
  EXPECT_NEAR(after(0.5), 0.9 * std::pow(0.5, -0.25), 1e-15);
  EXPECT_NEAR(after(1.0), 0.9, 1e-15);
  EXPECT_NEAR(after(2.0), 0.9 * std::pow(2.0, -0.25), 1e-15);
}

TEST(StepController, ChangesAreLimited) {
  EXPECT_NEAR(after(0.0), 6.0, 1e-12);
  EXPECT_NEAR(after(1e-30), 6.0, 1e-12);
  EXPECT_NEAR(after(1e30), 0.2, 1e-12);
}

TEST(StepController, AnErrorThatIsNoNumberIsARejection) {
  double proposal = 0.0;
  for (double error :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(StepController(4).accept(1.0, error, &proposal));
    EXPECT_EQ(proposal, 0.2);
  }
}

TEST(StepController, NeverGrowsRightAfterARejection) {
  StepController controller(4);
  double proposal = 0.0;
  ASSERT_FALSE(controller.accept(1.0, 3.0, &proposal));
  ASSERT_TRUE(controller.accept(0.5, 1e-6, &proposal));
  EXPECT_EQ(proposal, 0.5);
  ASSERT_TRUE(controller.accept(0.5, 1e-6, &proposal));
  EXPECT_GT(proposal, 0.5) << "only once";
  EXPECT_EQ(controller.back_off(0.5), 0.1);
  ASSERT_TRUE(controller.accept(0.1, 1e-6, &proposal));
  EXPECT_EQ(proposal, 0.1) << "a step that could not be computed counts as rejected";
}

TEST(StepController, AGrowingErrorIsForeseen) {
  // Gustafsson: the error went from 0.1 to 0.5 at the same step, and will go on growing.
  StepController controller(4);
  double proposal = 0.0;
  ASSERT_TRUE(controller.accept(1.0, 0.1, &proposal));
  ASSERT_TRUE(controller.accept(1.0, 0.5, &proposal));
  EXPECT_NEAR(proposal, 0.9 * std::pow(0.5 * 0.5 / 0.1, -0.25), 1e-15);
}

Study study_of(const std::string& controllers, const std::string& reference = "0.0") {
  return read_study(
      {"test.yaml", "duration: 2.0\ncontrollers:\n" + controllers +
                        "objective: {integral: [{signal: hinge/position, reference: " + reference +
                        "}]}\n"},
      read_urdf({"test.urdf", pendulum()}));
}

TEST(BreakTimes, AreWaypointsOfSetpointsAndReferences) {
  const BreakTimes breaks(
      study_of("  a: {type: pid, input: hinge/position, output: hinge, gains: {p: 1.0}, setpoint: "
               "{type: waypoints, times: [0.5, 1.5], "
               "positions: [0, 1]}}\n",
               "{type: waypoints, times: [0.0, 0.7], positions: [0, 1]}"));
  EXPECT_EQ(breaks.next(0.0, 2.0), 0.5);
  EXPECT_EQ(breaks.next(0.5, 2.0), 0.7);
  EXPECT_EQ(breaks.next(0.5 - 1e-15, 2.0), 0.7) << "reached, to rounding";
  EXPECT_EQ(breaks.next(0.7, 1.0), 1.0);
  EXPECT_EQ(breaks.next(1.5, 2.0), 2.0);
}

TEST(BreakTimes, OfAShapedInputAreItsKinks) {
  const BreakTimes linear(
      study_of("  a: {type: basis, output: hinge, duration: 1.0, coefficients: [0, 1, 0]}\n"));
  EXPECT_EQ(linear.next(0.0, 2.0), 0.5);
  EXPECT_EQ(linear.next(0.5, 2.0), 1.0);
  const BreakTimes cubic(
      study_of("  a: {type: basis, shape: cubic, output: hinge, duration: 1.0, coefficients: [0, "
               "1, 0, 2, 3, 0]}\n"));
  EXPECT_EQ(cubic.next(0.0, 2.0), 1.0);
  EXPECT_EQ(BreakTimes(study_of("  a: {type: basis, output: hinge, coefficients: [0, 1]}\n"))
                .next(0.0, 0.3),
            0.3);
}

TEST(BreakTimes, OfSamplesAreTheSamplesAtTheDelayOfTheStart) {
  Study study = study_of(
      "  a: {type: pid, input: hinge/position, output: hinge, gains: {p: 1.0}, setpoint: 0.0}\n");
  ReferenceDescription& setpoint = study.controllers.front().setpoint;
  setpoint.kind = ReferenceDescription::Kind::kSampled;
  setpoint.sampled.samples = std::make_shared<const SampledFunction>(std::vector<double>{0.5, 0.75},
                                                                     std::vector<double>{0.0, 1.0});
  setpoint.sampled.delay = Quantity(0.125);
  const BreakTimes breaks(study);
  EXPECT_EQ(breaks.next(0.0, 2.0), 0.375);
  EXPECT_EQ(breaks.next(0.375, 2.0), 0.625);
  EXPECT_EQ(breaks.next(0.625, 2.0), 2.0);
}

// The push acts for 20 ms in the middle of a long rest.
TEST(BreakTimes, NothingIsOverlookedAfterARest) {
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const auto system = compile(
        pendulum(),
        std::string(
            "duration: 2.0\nobjective: {integral: [{signal: hinge/velocity}]}\ncontrollers:\n"
            "  push: {type: state_feedback, output: hinge, feedback: [{signal: hinge/velocity, "
            "gain: 0.0}],\n"
            "    feedforward: {type: waypoints, times: [1.0, 1.01, 1.02], positions: [0, 10, 0], "
            "interpolation: linear}}\n"
            "solver: {integrator: ") +
            integrator + "}\n");
    const auto engine = make_integrator(*system);
    ASSERT_TRUE(engine->start({}).ok());
    std::vector<double> ends;
    while (engine->state().t < 2.0) {
      ASSERT_TRUE(engine->advance(2.0).ok());
      ends.push_back(engine->state().t);
    }
    for (double time : {1.0, 1.01, 1.02})
      EXPECT_TRUE(std::any_of(ends.begin(), ends.end(),
                              [time](double end) { return std::abs(end - time) < 1e-12; }))
          << integrator << time;
    EXPECT_GT(engine->psi(), 1e-3) << integrator;
  }
}

// Expressions of the time that act for a thousandth of a long rest.
TEST(BreakTimes, NoPulseOfAnExpressionIsOverlooked) {
  for (const char* integrator : {"rosenbrock", "idas"})
    for (const char* push : {"${t > 0.503 ? (t < 0.504 ? height : 0) : 0}",
                             "${2*height/sqrt(pi)*exp(-((t - 0.5035)/5e-4)^2)}"}) {
      const auto system = compile(
          pendulum(),
          std::string(
              "duration: 1.0\ngravity: [0, 0, 0]\nparameters: {height: {initial: 100}}\n"
              "objective: {terminal: [{signal: hinge/velocity}]}\nloads: [{joint: hinge, effort: "
              "\"") +
              push + "\"}]\nsolver: {integrator: " + integrator + "}\n");
      const auto engine = make_integrator(*system);
      ASSERT_TRUE(engine->start({100.0}).ok());
      while (engine->state().t < 1.0) ASSERT_TRUE(engine->advance(1.0).ok());
      // The impulse by the inertia about the hinge.
      const double speed = std::sqrt(engine->equations().terminal(engine->state()));
      EXPECT_NEAR(speed, 0.1 / (0.0834 + 0.25), 1e-4) << integrator << push;
    }
}

TEST(BreakTimes, APulseCountsAlsoWhereItsHeightStartsAtZero) {
  const double half = 5e-4 * std::sqrt(std::log(2.0));
  for (const char* height : {"0", "0.5"}) {
    const auto system =
        compile(pendulum(), std::string("duration: 1.0\nparameters: {height: {initial: ") + height +
                                ", lower: -1, upper: 1}}\nobjective: {terminal: [{signal: "
                                "hinge/velocity}]}\nloads: [{joint: hinge, effort: "
                                "\"${height*exp(-((t - 0.504)/5e-4)**2)}\"}]\n");
    const BreakTimes breaks(system->study());
    EXPECT_NEAR(breaks.next(0.0, 1.0), 0.504 - half, 1e-2 * half);
    EXPECT_NEAR(breaks.next(0.504 + 1e-5, 1.0), 0.504 + half, 1e-2 * half);
    EXPECT_EQ(breaks.times().size(), 3u);
  }
}

}  // namespace

}  // namespace codesign
