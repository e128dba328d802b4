// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <memory>

#include "description/study.h"
#include "equations/compiled_system.h"
#include "integration/command_inputs.h"
#include "integration/integrator.h"
#include "integration/rounded_linkages.h"
#include "integration/run_ends.h"
#include "integration/servo.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const char* const kHold =
    "{hold: {type: pid, input: hinge/position, setpoint: 0, output: hinge, gains: {p: 1}}}";

/// A pendulum of one second, turning at `rate` [rad/s] at some time.
struct Watched {
  explicit Watched(const std::string& solver, const std::string& controllers = kHold)
      : system(compile(
            pendulum(),
            "duration: 1\ncontrollers: " + controllers +
                "\nparameters: {}\nobjective: {integral: [{signal: hinge/position}]}\nsolver: " +
                solver + "\n")),
        equations(*system),
        watch(*system) {
    equations.set_design({});
    start.resize(system->layout());
    start.q[2] = -0.5;
    start.q[3] = 1.0;
    watch.start(equations, start);
  }

  Status check(double time, double rate, std::int64_t work) {
    State<double> state = start;
    state.t = time;
    state.v[5] = 0.5 * rate;
    return watch.check(state, work);
  }

  std::shared_ptr<const CompiledSystem> system;
  Equations<double> equations;
  MotionWatch watch;
  State<double> start;
};

// A fall through 0.5 m is sqrt(2 g / 0.5 m) = 6.3 rad/s: 63 rad/s are beyond reason, and so is a
// pace of 1e6 steps per second.
TEST(MotionWatch, EndsWhatIsBothTooFastAndTooMuchWork) {
  Watched slow("{}"), quick("{}"), neither("{}");
  EXPECT_TRUE(slow.check(5e-4, 60.0, 600).ok());
  EXPECT_TRUE(quick.check(0.5, 70.0, 600).ok());
  const Status status = Watched("{}").check(5e-4, 70.0, 600);
  EXPECT_EQ(status.code, StatusCode::kUnstableMotion);
  EXPECT_EQ(status.time, 5e-4);
  EXPECT_NE(status.cause.find("link 'bar' turns at 70 rad/s"), std::string::npos) << status.cause;
  EXPECT_NE(status.cause.find("solver.maximum_speed"), std::string::npos) << status.cause;
}

TEST(MotionWatch, JudgesThePaceOfTheLastStepsAlone) {
  Watched watched("{}");
  EXPECT_TRUE(watched.check(1e-5, 0.0, 600).ok());
  EXPECT_TRUE(watched.check(0.5, 70.0, 1200).ok());
  EXPECT_TRUE(watched.check(0.5001, 70.0, 1600).ok())
      << "a window of 400 steps is too short to tell";
  EXPECT_EQ(watched.check(0.5001, 70.0, 1800).code, StatusCode::kUnstableMotion);
}

TEST(MotionWatch, SpeedsAskedForAreWithinReason) {
  const char* const spindle =
      "{motor: {type: pid, input: hinge/velocity, setpoint: 50, output: hinge, gains: {p: 1}}}";
  EXPECT_TRUE(Watched("{}", spindle).check(5e-4, 490.0, 600).ok());
  EXPECT_FALSE(Watched("{}", spindle).check(5e-4, 510.0, 600).ok());
}

/// Watched, with a set-point of 5 rad/s that can be commanded.
Status check_commanded(const LiveFunction& setpoint, const LiveFunction& effort, double rate) {
  const char* const spindle =
      "{motor: {type: pid, input: hinge/velocity, setpoint: 5, output: hinge, gains: {p: 1}}}";
  const Watched planned("{}", spindle);
  Study study = planned.system->whole_study();
  *make_live(&study.controllers[0].setpoint) = setpoint;
  *make_live(&study.controllers[0].feedforward) = effort;
  const CompiledSystem system(planned.system->robot(), study);
  MotionWatch watch(system);
  watch.start(planned.equations, planned.start);
  State<double> state = planned.start;
  state.t = 5e-4;
  state.v[5] = 0.5 * rate;
  return watch.check(state, 600);
}

TEST(MotionWatch, SpeedsCommandedAreWithinReason) {
  const LiveFunction none, fast{true, 0.0, {200.0}}, rest{true, 0.0, {}};
  EXPECT_FALSE(check_commanded(none, none, 250.0).ok());
  EXPECT_TRUE(check_commanded(fast, none, 250.0).ok());
  EXPECT_TRUE(check_commanded(fast, rest, 1990.0).ok());
  EXPECT_FALSE(check_commanded(fast, rest, 2010.0).ok());
  EXPECT_TRUE(check_commanded(none, {true, 0.0, {30.0}}, 1e5).ok()) << "an effort tells no speed";
}

TEST(MotionWatch, WhatNothingDrivesCannotRunAway) {
  EXPECT_TRUE(Watched("{}", "{}").check(5e-4, 1e5, 600).ok());
  EXPECT_FALSE(Watched("{maximum_speed: 20}", "{}").check(5e-4, 1e5, 600).ok());
}

TEST(MotionWatch, MoreStepsMayBeAllowed) {
  EXPECT_TRUE(Watched("{maximum_steps: 100000000}").check(5e-4, 70.0, 600).ok());
}

TEST(MotionWatch, ASpeedGivenIsTheBoundAtOnce) {
  Watched watched("{maximum_speed: 20}");
  EXPECT_TRUE(watched.check(0.1, 19.0, 5).ok());
  const Status status = watched.check(0.1, 21.0, 6);
  EXPECT_EQ(status.code, StatusCode::kUnstableMotion);
  EXPECT_NE(status.cause.find("beyond 20"), std::string::npos) << status.cause;
  EXPECT_TRUE(Watched("{maximum_speed: 1000}").check(5e-4, 900.0, 600).ok());
}

struct End {
  Status status;
  Statistics statistics;
};

End run(const std::string& urdf, const std::string& study) {
  const Problem problem = load_problem({"rounded.urdf", urdf}, {}, {"rounded.yaml", study});
  const auto integrator = make_integrator(*system_of(problem));
  Status status = integrator->start(problem.parameters());
  while (status.ok() && integrator->state().t < study_of(problem).duration)
    status = integrator->advance(study_of(problem).duration);
  return {status, integrator->statistics()};
}

TEST(Standstill, FrictionBeforeASingularPositionEndsTheRunWithItsTimeRankAndJoints) {
  for (double tolerance : {1e-6, 1e-8}) {
    const End end = run(rounded::three_cranks(), rounded::study(rounded::three_cranks_start(),
                                                                "j0/velocity", 1.0, tolerance));
    EXPECT_EQ(end.status.code, StatusCode::kSingularConfiguration) << end.status.cause;
    EXPECT_NEAR(end.status.time, 0.3401, 1e-3);
    EXPECT_NE(end.status.cause.find("singular position"), std::string::npos) << end.status.cause;
    EXPECT_NE(end.status.cause.find("the friction of 'j0'"), std::string::npos) << end.status.cause;
    EXPECT_NE(end.status.cause.find("'close"), std::string::npos) << end.status.cause;
    EXPECT_LT(end.statistics.steps, 5000);
  }
}

TEST(Standstill, ARunThatNeverComesNearIsLeftAlone) {
  const End end = run(rounded::three_cranks(),
                      rounded::study(rounded::three_cranks_start(), "j0/velocity", 0.1, 1e-6));
  EXPECT_TRUE(end.status.ok()) << end.status.cause;
}

TEST(Standstill, ARingWhoseRowsTakeTurnsIsNotCalledSingular) {
  const End end =
      run(rounded::bennett(), rounded::study(rounded::bennett_start(), "t1/velocity", 1.0, 1e-7));
  EXPECT_EQ(end.status.code, StatusCode::kSingularConfiguration) << end.status.cause;
  EXPECT_NEAR(end.status.time, 0.6803, 2e-3);
  EXPECT_NE(end.status.cause.find("although all constraints together keep their rank"),
            std::string::npos)
      << end.status.cause;
}

TEST(FiniteFrame, NamesWhatIsNot) {
  FrameNames names;
  names.joints = {"shoulder", "elbow"};
  names.frictions = {"elbow"};
  names.controllers = {"servo"};
  names.links = {"base", "arm"};
  Frame frame;
  frame.joints.resize(2);
  frame.frictions.resize(1);
  frame.controllers.resize(1);
  frame.links.resize(2);
  frame.signals = {1.0, 2.0};
  EXPECT_EQ(find_not_finite(names, frame), "");
  frame.signals[1] = std::nan("");
  EXPECT_EQ(find_not_finite(names, frame), "signal number 2 of the requested ones is not finite");
  frame.links[1].position[2] = HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "the pose of link \"arm\" is not finite");
  frame.controllers[0].output = -HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "controller \"servo\" is not finite");
  frame.frictions[0].force[0] = HUGE_VAL;
  EXPECT_EQ(find_not_finite(names, frame), "the friction of joint \"elbow\" is not finite");
  frame.joints[1].effort = std::nan("");
  EXPECT_EQ(find_not_finite(names, frame), "the motion of joint \"elbow\" is not finite");
}

// 3 times 0.3 is a last bit below 0.9, and so are sums of steps.
TEST(RunEnds, ARunReachesItsEndABitBehindAnEvent) {
  const std::string sampled =
                        "controllers: {hold: {type: pid, input: hinge/position, setpoint: 0.5, "
                        "output: hinge, gains: {p: 1}, sample_time: 0.03}}\n",
                    points =
                        "objective: {integral: [{signal: hinge/position, reference: {type: "
                        "waypoints, times: [0, 0.8999999999999999], positions: [0, 1]}}]}\n";
  for (const char* integrator : {"rosenbrock", "idas"})
    for (const std::string& more : {sampled, points, std::string()})
      for (const char* duration : {"0.33", "0.45", "0.9", "2.9", "3.1", "3.4"}) {
        const auto system =
            compile(pendulum(), std::string("duration: ") + duration + "\ngravity: [0, 0, 0]\n" +
                                    more + "solver: {integrator: " + integrator + "}\n");
        const auto engine = make_integrator(*system);
        ASSERT_TRUE(engine->start({}).ok());
        while (engine->state().t < system->study().duration) {
          const Status status = engine->advance(system->study().duration);
          ASSERT_TRUE(status.ok()) << integrator << more << duration << status.cause;
        }
      }
}

// A load that grows with the square of the velocity has no motion beyond 0.2 s: the step becomes
// too short, but the cause is the load.
TEST(MotionWatch, ALoadThatRunsAwayIsNoDeadPoint) {
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const std::string study =
        std::string(
            "duration: 10\ngravity: [0, 0, 0]\nloads: [{joint: hinge, effort: \"${5*hinge/"
            "velocity^3}\"}]\ninitial_state: {hinge: {velocity: 1}}\nsolver: {integrator: ") +
        integrator + "}\n";
    const auto system = compile(pendulum(), study);
    const auto run = make_integrator(*system);
    Status status = run->start(system->parameters());
    while (status.ok() && run->state().t < 10.0) status = run->advance(10.0);
    EXPECT_EQ(status.code, StatusCode::kUnstableMotion) << integrator << ": " << status.cause;
    for (const char* part : {"'bar'", "runs away", "loads"})
      EXPECT_NE(status.cause.find(part), std::string::npos) << integrator << ": " << status.cause;
  }
}

}  // namespace

}  // namespace codesign
