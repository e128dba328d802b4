// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string realization_text(const std::string& keys,
                             const std::string& gains = "{p: 1.0, i: 2.0, d: 3.0}") {
  return kLeastStudy +
         "parameters: {tau: {initial: 0.02}}\ncontrollers:\n  speed: {type: pid, input: "
         "crank_joint/velocity, setpoint: 0, output: "
         "crank_joint, gains: " +
         gains + ", " + keys + "}\n";
}

TEST(StudyRealization, ReadsEveryKey) {
  const Study study =
      read_text(realization_text("i_clamp: 4.0, antiwindup: true, derivative_filter: \"${tau}\", "
                                 "output_limit: 9.0, time_constant: \"${tau/2}\", sample_time: "
                                 "0.001, delay: 0.0025, quantization: 0.1"));
  const ControlRealization& realization = study.controllers.at(0).realization;
  EXPECT_EQ(realization.i_clamp->upper.nominal(), 4.0);
  EXPECT_EQ(realization.antiwindup, AntiWindup::kClamping);
  EXPECT_EQ(realization.derivative_filter->nominal(), 0.02);
  EXPECT_EQ(realization.output_limit->upper.nominal(), 9.0);
  EXPECT_EQ(realization.time_constant->nominal(), 0.01);
  EXPECT_EQ(realization.sample_time, 0.001);
  EXPECT_EQ(realization.delay, 0.0025);
  EXPECT_EQ(realization.quantization, 0.1);
  EXPECT_EQ(realization.queued(), 3);
}

TEST(StudyRealization, ReadsBoundsOfTwoNumbers) {
  const auto realization = [](const std::string& keys) {
    return read_text(realization_text(keys)).controllers.at(0).realization;
  };
  const ControlRealization both =
      realization("i_clamp: [\"${-tau}\", 3.0], output_limit: [-2.0, 9.0], antiwindup: clamping");
  EXPECT_EQ(both.i_clamp->lower->nominal(), -0.02);
  EXPECT_EQ(both.i_clamp->upper.nominal(), 3.0);
  EXPECT_EQ(both.output_limit->lower->nominal(), -2.0);
  EXPECT_EQ(both.antiwindup, AntiWindup::kClamping);
  EXPECT_FALSE(both.limit_has_corners);
  // Corners may be at zero.
  for (const char* keys :
       {"sample_time: 0.1, output_limit: [0, 5]", "antiwindup: conditional, output_limit: [0, 5]"})
    EXPECT_EQ(realization(keys).output_limit->lower->nominal(), 0.0);
}

TEST(StudyRealization, ReadsAntiWindup) {
  const auto realization = [](const std::string& keys) {
    return read_text(realization_text("output_limit: 2, " + keys)).controllers.at(0).realization;
  };
  const ControlRealization tracking =
      realization("antiwindup: back_calculation, tracking_time: \"${tau}\"");
  EXPECT_EQ(tracking.antiwindup, AntiWindup::kBackCalculation);
  EXPECT_EQ(tracking.tracking_time->nominal(), 0.02);
  EXPECT_TRUE(tracking.limit_has_corners);
  EXPECT_EQ(realization("antiwindup: conditional").antiwindup, AntiWindup::kConditional);
  EXPECT_EQ(realization("antiwindup: yes, i_clamp: 1").antiwindup, AntiWindup::kClamping);
}

TEST(StudyRealization, IsOffByDefault) {
  const ControlRealization realization =
      read_text(realization_text("antiwindup: false, i_clamp: 1")).controllers.at(0).realization;
  EXPECT_EQ(realization.antiwindup, AntiWindup::kNone);
  EXPECT_FALSE(realization.is_sampled());
  EXPECT_FALSE(realization.derivative_filter || realization.output_limit ||
               realization.time_constant);
  EXPECT_EQ(realization.queued(), 0);
}

TEST(StudyRealization, TheDerivativeActsOnTheErrorUnlessToldOtherwise) {
  const auto rates_input = [](const std::string& keys) {
    return read_text(realization_text(keys)).controllers.at(0).realization.rates_input;
  };
  EXPECT_FALSE(rates_input("i_clamp: 1"));
  EXPECT_FALSE(rates_input("derivative: error"));
  EXPECT_TRUE(rates_input("derivative: measurement"));
}

TEST(StudyRealization, TheAdjointGoesBackOverSamples) {
  for (const char* keys : {"sample_time: 0.01", "derivative_filter: 0.01"})
    EXPECT_NO_THROW(read_text(realization_text(keys) + "solver: {gradient: adjoint}\n")) << keys;
}

TEST(StudyRealization, AControllerWithoutAJointMustBeRead) {
  const std::string outer = kLeastStudy +
                            "controllers:\n  outer: {type: pid, input: slider_joint/position, "
                            "setpoint: 0, gains: {p: 1}}\n";
  const std::string inner =
      "  inner: {type: pid, input: crank_joint/velocity - outer/output, setpoint: 0, output: "
      "crank_joint, gains: {p: 1}}\n";
  EXPECT_EQ(read_text(outer + inner).controllers.at(0).output, "");
  expect_fault(outer, "controllers.outer.output", "no later controller reads", 4);
  expect_fault(kLeastStudy +
                   "controllers:\n  outer: {type: pid, input: slider_joint/position, setpoint: 0, "
                   "gains: {p: 1}, time_constant: 1}\n" +
                   inner,
               "controllers.outer.time_constant", "needs output", 4);
}

std::string text_of(const std::string& hardware, const std::string& gains = "{p: 2.0, d: 0.1}") {
  return kLeastStudy +
         "parameters: {limit: {initial: 3.0}}\ncontrollers:\n  speed: {type: pid, input: "
         "crank_joint/velocity, setpoint: 0, output: " +
         "crank_joint, gains: " + gains +
         "}\n  push: {type: state_feedback, output: slider_joint, feedforward: 1.0}\nhardware: " +
         hardware + "\n";
}

TEST(StudyHardware, ReadsEveryField) {
  const std::string text = text_of(
      "{speed: {namespace: /crank/pid/, i_clamp: \"${limit}\", antiwindup: true}}", "{p: 1, i: 2}");
  const Study study = read_text(text);
  ASSERT_EQ(study.hardware.size(), 1U);
  const HardwareGains& gains = study.hardware[0];
  EXPECT_EQ(gains.controller, "speed");
  EXPECT_EQ(gains.name_space, "crank/pid");
  ASSERT_TRUE(gains.i_clamp);
  EXPECT_EQ(gains.i_clamp->upper.nominal(), 3.0);
  EXPECT_TRUE(gains.antiwindup);
  EXPECT_EQ(gains.where.line, 7);
}

TEST(StudyHardware, NoIntegralNeedsNoClamp) {
  const Study study = read_text(text_of("{speed: {namespace: crank}}"));
  EXPECT_FALSE(study.hardware.at(0).i_clamp);
  EXPECT_FALSE(study.hardware.at(0).antiwindup);
  EXPECT_TRUE(read_text(kLeastStudy).hardware.empty());
}

TEST(StudyHardware, TakesTheClampOfTheController) {
  std::string text =
      text_of("{speed: {namespace: a}}", "{p: 1, i: 2}, i_clamp: 4, antiwindup: true");
  const HardwareGains gains = read_text(text).hardware.at(0);
  ASSERT_TRUE(gains.i_clamp);
  EXPECT_EQ(gains.i_clamp->upper.nominal(), 4.0);
  EXPECT_TRUE(gains.antiwindup);
  expect_fault(text_of("{speed: {namespace: a, i_clamp: 3}}", "{p: 1, i: 2}, i_clamp: 4"),
               "hardware.speed.i_clamp", "has i_clamp already", 7);
}

TEST(StudyHardware, TwoControllersHaveTwoPlaces) {
  const std::string two =
      "  slow: {type: pid, input: slider_joint/position, setpoint: 0, output: slider_joint, gains: "
      "{p: 1}}\n";
  const auto with = [&two](const std::string& hardware) {
    std::string text = text_of(hardware);
    return text.insert(text.find("hardware:"), two);
  };
  EXPECT_EQ(
      read_text(with("{speed: {namespace: arm/a}, slow: {namespace: arm/ab}}")).hardware.size(),
      2U);
  expect_fault(with("{speed: {namespace: arm/a}, slow: {namespace: arm/a}}"),
               "hardware.slow.namespace", "gains of \"speed\"", 8);
  expect_fault(with("{speed: {namespace: arm/a}, slow: {namespace: arm}}"),
               "hardware.slow.namespace", "gains of \"speed\"", 8);
}

}  // namespace
}  // namespace codesign
