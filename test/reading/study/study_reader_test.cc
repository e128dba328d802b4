// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_reader.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(StudyReader, ReadsAWholeStudy) {
  const Study study = read_text(R"(
duration: 2.0
gravity: [0, 0, -1.62]
initial_state:
  crank_joint: {position: "${crank_length/8}", velocity: -10.0}
  slider_joint: {guess: 0.2}
controllers:
  crank_speed: {type: pid, input: crank_joint/velocity, setpoint: -10.0, output: crank_joint, gains: {p: "${Kp}"}}
parameters:
  Kp: {initial: 1.5, lower: -5.0, upper: 5.0}
  crank_length: {}
objective:
  integral: [{signal: crank_joint/velocity, reference: -10.0}, {signal: crank_speed/output, weight: 0.01}]
  terminal: []
constraints: ["rod_length - crank_length >= 0.165"]
solver: {integrator: rosenbrock, relative_tolerance: 1.0e-8}
optimizer: {algorithm: slsqp}
)");
  EXPECT_EQ(study.file, "study.yaml");
  EXPECT_EQ(study.duration, 2.0);
  EXPECT_EQ(study.gravity[2], -1.62);
  ASSERT_EQ(study.initial_state.size(), 2U);
  EXPECT_DOUBLE_EQ(study.initial_state[0].position->nominal(), 0.01);
  EXPECT_EQ(study.initial_state[0].velocity->nominal(), -10.0);
  EXPECT_FALSE(study.initial_state[0].guess.has_value());
  EXPECT_EQ(study.initial_state[1].guess, 0.2);
  EXPECT_EQ(study.initial_state[1].where.line, 6);
  EXPECT_EQ(study.controllers.size(), 1U);
  EXPECT_EQ(study.parameters.size(), 3U);
  EXPECT_EQ(study.tuned, (std::vector<int>{2, 0}));
  EXPECT_EQ(study.integral.size(), 2U);
  EXPECT_TRUE(study.terminal.empty());
  EXPECT_EQ(study.constraints.size(), 1U);
  EXPECT_EQ(study.solver.relative_tolerance, 1e-8);
  EXPECT_EQ(study.solver.absolute_tolerance, 1e-7);
  EXPECT_EQ(study.optimizer.algorithm, "slsqp");
}

TEST(StudyReader, TheRestHasDefaults) {
  const Study study = read_text(kLeastStudy);
  EXPECT_EQ(study.gravity, (std::array<double, 3>{0.0, 0.0, -9.81}));
  EXPECT_TRUE(study.initial_state.empty());
  EXPECT_TRUE(study.controllers.empty());
  EXPECT_TRUE(study.tuned.empty());
  ASSERT_EQ(study.parameters.size(), 2U);
  EXPECT_EQ(study.parameters[1].name, "rod_length");
  EXPECT_EQ(study.solver.integrator, IntegratorKind::kRosenbrock);
  EXPECT_EQ(study.optimizer.algorithm, "auto");
}

TEST(StudyReader, RefusesADurationThatIsNone) {
  const std::string objective = "\nobjective: {integral: [{signal: crank_joint/velocity}]}\n";
  expect_fault("duration: 0" + objective, "duration", "must be positive", 1);
  expect_fault("duration: -1" + objective, "duration", "must be positive", 1);
  expect_fault("duration: .inf" + objective, "duration", "not finite", 1);
  expect_fault("duration: .nan" + objective, "duration", "not finite", 1);
  expect_fault("duration: long" + objective, "duration", "not a number", 1);
  expect_fault("duration: [1]" + objective, "duration", "expected a number, found a list", 1);
  EXPECT_EQ(fault_in("duration: -1" + objective).value, "-1");
  EXPECT_EQ(fault_in("duration: -1" + objective).allowed, "more than 0 s");
}

TEST(StudyReader, ABaseIsFixedOrFloats) {
  const auto floats = [](const std::string& text) { return has_floating_base({"s.yaml", text}); };
  EXPECT_TRUE(floats("duration: 1\nbase: floating"));
  EXPECT_TRUE(floats("duration: 1\nbase: \"float\\x69ng\"")) << "spelled with an escape";
  EXPECT_FALSE(floats("duration: 1\nbase: fixed"));
  EXPECT_FALSE(floats("duration: 1 # not floating"));
  const std::string objective = "\nobjective: {terminal: [{signal: crank_joint/velocity}]}";
  expect_fault("duration: 1\nbase: swimming" + objective, "base", "unknown", 2);
}

}  // namespace
}  // namespace codesign
