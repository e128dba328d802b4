// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The whole turns of a loop's joint, however long the steps are.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/interactive_simulation.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "integration/turning_loops.h"

namespace codesign {
namespace {

std::string solver_line(const std::string& coordinates, const std::string& method) {
  return "solver: {coordinates: " + coordinates + ", " +
         (method == "idas" ? "integrator: idas" : "method: " + method) + "}\n";
}

std::string turning_study(const std::string& start, double duration, const std::string& more) {
  return "duration: " + std::to_string(duration) + "\ngravity: [0, 0, 0]\ninitial_state: " + start +
         "\nparameters: {k: {}}\nobjective: {terminal: [{signal: pin/position}]}\n" + more;
}

std::string turning(const std::string& joint, double speed, const std::string& more = "") {
  return "{" + joint + ": {position: 0.3, velocity: " + std::to_string(speed) + "}" + more + "}";
}

JointSample turning_joint(const Simulation& simulation, const Frame& frame,
                          const std::string& name) {
  for (std::size_t k = 0; k < frame.joints.size(); ++k)
    if (simulation.names().joints[k] == name) return frame.joints[k];
  ADD_FAILURE() << "no joint " << name;
  return {};
}

using Solver = std::tuple<const char*, const char*>;

class LoopTurns : public testing::TestWithParam<Solver> {
 protected:
  std::string solver_block() const {
    return solver_line(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
  bool is_absolute() const { return std::get<0>(GetParam()) == std::string("absolute"); }
};

// In joint coordinates some steps are hundreds of turns long.
TEST_P(LoopTurns, ThePinTurnsAsFarAsTheCrank) {
  for (double speed : {1.0, 50.0, -500.0}) {
    const double duration = is_absolute() ? 60.0 / std::abs(speed) : 10.0;
    const auto system = compile(rotor_with_slides(),
                                turning_study(turning("crank", speed), duration, solver_block()));
    Simulation run = simulation_of(system, system->parameters());
    ASSERT_TRUE(run.start().ok());
    Frame frame;
    for (int k = 0; k <= 37; ++k) {
      const double time = duration * k / 37;
      const Status status = run.advance(time);
      ASSERT_TRUE(status.ok()) << status.cause;
      run.sample(time, &frame);
      const double crank = turning_joint(run, frame, "crank").position;
      EXPECT_NEAR(turning_joint(run, frame, "pin").position, crank, 1e-4 + 1e-6 * std::abs(crank))
          << speed << " rad/s at " << time;
      EXPECT_NEAR(crank, 0.3 + speed * time, 1e-2 + 1e-4 * std::abs(speed * time));
    }
  }
}

// In joint coordinates up to 197 turns; in absolute ones, where steps resolve each turn, 20.
TEST_P(LoopTurns, ASpringOverManyTurnsSwingsAsTheFormulaSays) {
  const double speed = is_absolute() ? 30.0 : 300.0;
  const auto system = compile(rotor_with_slides(pin_spring()),
                              "duration: 10.0\ngravity: [0, 0, 0]\ninitial_state: {crank: "
                              "{position: 0, velocity: " +
                                  std::to_string(speed) +
                                  "}}\nparameters: {k: {}}\nobjective: {terminal: [{signal: "
                                  "pin/position}]}\n" +
                                  solver_block());
  Simulation run = simulation_of(system, system->parameters());
  ASSERT_TRUE(run.start().ok());
  const double rate = std::sqrt(0.001 / kRotorInertia);
  Frame frame;
  for (int k = 1; k <= 50; ++k) {
    const double time = 0.2 * k;
    const Status status = run.advance(time);
    ASSERT_TRUE(status.ok()) << status.cause;
    run.sample(time, &frame);
    EXPECT_NEAR(turning_joint(run, frame, "pin").position, speed / rate * std::sin(rate * time),
                0.1)
        << time;
  }
  EXPECT_LT(run.statistics().energy_error, 1e-3);
}

TEST_P(LoopTurns, AControllerOfThePinReachesManyTurns) {
  const auto system = compile(
      rotor_with_slides(),
      "duration: 20.0\ngravity: [0, 0, 0]\ninitial_state: {crank: {position: "
      "0}}\nparameters: {k: {}}\ncontrollers: "
      "{turn: {type: pid, input: pin/position, setpoint: 500, output: crank, gains: {p: 0.2, d: "
      "0.1}}}\nobjective: {terminal: [{signal: turn/error}]}\n" +
          solver_block());
  Simulation run = simulation_of(system, system->parameters());
  ASSERT_TRUE(run.start().ok());
  const Status status = run.advance(20.0);
  ASSERT_TRUE(status.ok()) << status.cause;
  Frame frame;
  run.sample(20.0, &frame);
  EXPECT_NEAR(turning_joint(run, frame, "crank").position, 500.0, 1e-2);
  EXPECT_NEAR(run.objective(), 0.0, 1e-3);
}

TEST_P(LoopTurns, GoOnWhereACommandBegins) {
  const auto system =
      compile(rotor_with_slides(), turning_study(turning("crank", 200.0), 3.0, solver_block()));
  InteractiveSimulation run(
      *system, {},
      {parse_signal("pin/position", {}, "signal"), parse_signal("crank/position", {}, "signal")});
  ASSERT_TRUE(run.start(system->parameters()).ok());
  Frame frame;
  for (int k = 1; k <= 20; ++k) {
    const double time = 0.149 * k;
    const Status status = run.advance(time);
    ASSERT_TRUE(status.ok()) << status.cause;
    run.sample(time, &frame);
    EXPECT_NEAR(frame.signals[0], frame.signals[1], 1e-2) << time;
    run.set_effort(0, k % 2 == 0 ? 2.0 : -1.0);
    ASSERT_TRUE(run.apply(time).ok());
    run.sample(time, &frame);
    EXPECT_NEAR(frame.signals[0], frame.signals[1], 1e-2) << time;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, LoopTurns,
                         testing::Combine(testing::Values("joint", "absolute"),
                                          testing::Values("auto", "dopri5", "rodas4", "rodas5p",
                                                          "idas")),
                         [](const auto& instance) {
                           return std::string(std::get<0>(instance.param)) + "_" +
                                  std::get<1>(instance.param);
                         });

// The first step turns from 3.1 to 3.2 rad, across half a turn.
TEST(LoopTurns, ThePositionsOfTheStartAreItsReferences) {
  const auto system = compile(
      rotor_with_slides(),
      "duration: 0.1\ngravity: [0, 0, 0]\ninitial_state: {crank: {position: 3.1, velocity: 1}}\n"
      "parameters: {k: {}}\nobjective: {terminal: [{signal: pin/position}]}\n" +
          solver_line("joint", "dopri5"));
  Simulation run = simulation_of(system, system->parameters());
  ASSERT_TRUE(run.start().ok());
  ASSERT_TRUE(run.advance(0.1).ok());
  Frame frame;
  run.sample(0.1, &frame);
  EXPECT_NEAR(turning_joint(run, frame, "pin").position, 3.2, 1e-9);
}

// As it came from a user: the pin read 6.32 beside 50.3 of the crank.
TEST(LoopTurns, OfAParallelogramAreThoseOfItsCrank) {
  const auto system =
      compile(turning_parallelogram(),
              "duration: 10.0\ngravity: [0, 0, 0]\ninitial_state: {crank: {position: 0.3, "
              "velocity: 5}, follower: {guess: 0.3}}\nparameters: {k: {}}\nobjective: {terminal: "
              "[{signal: pin/position, reference: 50.3}]}\nsolver: {coordinates: joint}\n");
  Simulation run = simulation_of(system, system->parameters());
  ASSERT_TRUE(run.start().ok());
  ASSERT_TRUE(run.advance(10.0).ok());
  EXPECT_LT(run.statistics().steps, 20);
  EXPECT_NEAR(run.objective(), 0.0, 1e-10);
}

}  // namespace
}  // namespace codesign
