// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_realization.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string realization_text(const std::string& keys, const std::string& gains = "{p: 1.0, i: 2.0, d: 3.0}") {
  return kLeastStudy +
         "parameters: {tau: {initial: 0.02}}\ncontrollers:\n  speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: "
         "crank_joint, gains: " +
         gains + ", " + keys + "}\n";
}

TEST(StudyRealization, ReadsEveryKey) {
  const Study study = read_text(realization_text(
      "i_clamp: 4.0, antiwindup: true, derivative_filter: \"${tau}\", output_limit: 9.0, time_constant: \"${tau/2}\", sample_time: "
      "0.001, delay: 0.0025, quantization: 0.1"));
  const ControlRealization& realization = study.controllers.at(0).realization;
  EXPECT_EQ(realization.i_clamp->nominal(), 4.0);
  EXPECT_TRUE(realization.antiwindup);
  EXPECT_EQ(realization.derivative_filter->nominal(), 0.02);
  EXPECT_EQ(realization.output_limit->nominal(), 9.0);
  EXPECT_EQ(realization.time_constant->nominal(), 0.01);
  EXPECT_EQ(realization.sample_time, 0.001);
  EXPECT_EQ(realization.delay, 0.0025);
  EXPECT_EQ(realization.quantization, 0.1);
  EXPECT_EQ(realization.queued(), 3);
}

TEST(StudyRealization, IsOffByDefault) {
  const ControlRealization realization = read_text(realization_text("antiwindup: false, i_clamp: 1")).controllers.at(0).realization;
  EXPECT_FALSE(realization.antiwindup);
  EXPECT_FALSE(realization.is_sampled());
  EXPECT_FALSE(realization.derivative_filter || realization.output_limit || realization.time_constant);
  EXPECT_EQ(realization.queued(), 0);
}

TEST(StudyRealization, RefusesImpossibleNumbers) {
  for (const char* key : {"i_clamp", "derivative_filter", "output_limit", "time_constant"}) {
    expect_fault(realization_text(std::string(key) + ": 0"), "controllers.speed." + std::string(key), "must be positive", 5);
    expect_fault(realization_text(std::string(key) + ": \"${tau - 1}\""), "controllers.speed." + std::string(key), "must be positive", 5);
  }
  expect_fault(realization_text("sample_time: 0"), "controllers.speed.sample_time", "must be positive", 5);
  expect_fault(realization_text("sample_time: \"${tau}\""), "controllers.speed.sample_time", "must not depend on parameters", 5);
  expect_fault(realization_text("sample_time: 0.01, delay: -1"), "controllers.speed.delay", "must not be negative", 5);
  expect_fault(realization_text("sample_time: 0.01, delay: 1.01"), "controllers.speed.delay", "too many outputs wait at a time: 101", 5);
  // More than an int counts.
  expect_fault(realization_text("sample_time: 1.0e-9, delay: 3.0"), "controllers.speed.delay",
               "too many outputs wait at a time: 3000000000", 5);
  expect_fault(realization_text("sample_time: 1.0e-300, delay: 1.0e+300"), "controllers.speed.delay", "too many outputs wait", 5);
  expect_fault(realization_text("sample_time: 0.01, quantization: -1"), "controllers.speed.quantization", "must not be negative", 5);
  expect_fault(realization_text("antiwindup: 3, i_clamp: 1"), "controllers.speed.antiwindup", "", 5);
}

TEST(StudyRealization, RefusesKeysWithoutMeaning) {
  expect_fault(realization_text("delay: 0.01"), "controllers.speed.delay", "needs sample_time", 5);
  expect_fault(realization_text("quantization: 0.01"), "controllers.speed.quantization", "needs sample_time", 5);
  expect_fault(realization_text("antiwindup: true"), "controllers.speed.antiwindup", "needs i_clamp", 5);
  expect_fault(realization_text("i_clamp: 1", "{p: 1}"), "controllers.speed.i_clamp", "needs a gain i", 5);
  expect_fault(realization_text("derivative_filter: 1", "{p: 1}"), "controllers.speed.derivative_filter", "needs a gain d", 5);
  expect_fault(realization_text("sampletime: 1"), "controllers.speed.sampletime", "did you mean \"sample_time\"", 5);
  expect_fault(kLeastStudy + "controllers: {hold: {type: pd_gravity, setpoint: 0, output: crank_joint, gains: {p: 1.0}, i_clamp: 1}}\n",
               "controllers.hold.i_clamp", "unknown key", 3);
}

TEST(StudyRealization, RefusesTheAdjointOfSamples) {
  expect_fault(realization_text("sample_time: 0.01") + "solver: {gradient: adjoint}\n", "solver.gradient",
               "does not go back over the samples", 6);
  EXPECT_NO_THROW(read_text(realization_text("derivative_filter: 0.01") + "solver: {gradient: adjoint}\n"));
}

TEST(StudyRealization, AControllerWithoutAJointMustBeRead) {
  const std::string outer = kLeastStudy + "controllers:\n  outer: {type: pid, input: slider_joint/position, setpoint: 0, gains: {p: 1}}\n";
  const std::string inner =
      "  inner: {type: pid, input: crank_joint/velocity - outer/output, setpoint: 0, output: crank_joint, gains: {p: 1}}\n";
  EXPECT_EQ(read_text(outer + inner).controllers.at(0).output, "");
  expect_fault(outer, "controllers.outer.output", "no later controller reads", 4);
  expect_fault(kLeastStudy +
                   "controllers:\n  outer: {type: pid, input: slider_joint/position, setpoint: 0, gains: {p: 1}, time_constant: 1}\n" +
                   inner,
               "controllers.outer.time_constant", "needs output", 4);
}

}  // namespace
}  // namespace codesign
