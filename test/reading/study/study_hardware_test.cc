// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_hardware.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string text_of(const std::string& hardware, const std::string& gains = "{p: 2.0, d: 0.1}") {
  return kLeastStudy +
         "parameters: {limit: {initial: 3.0}}\ncontrollers:\n  speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: " +
         "crank_joint, gains: " + gains +
         "}\n  push: {type: state_feedback, output: slider_joint, feedforward: 1.0}\nhardware: " + hardware + "\n";
}

TEST(StudyHardware, ReadsEveryField) {
  const std::string text = text_of("{speed: {namespace: /crank/pid/, i_clamp: \"${limit}\", antiwindup: true}}", "{p: 1, i: 2}");
  const Study study = read_text(text);
  ASSERT_EQ(study.hardware.size(), 1U);
  const HardwareGains& gains = study.hardware[0];
  EXPECT_EQ(gains.controller, "speed");
  EXPECT_EQ(gains.name_space, "crank/pid");
  ASSERT_TRUE(gains.i_clamp);
  EXPECT_EQ(gains.i_clamp->nominal(), 3.0);
  EXPECT_TRUE(gains.antiwindup);
  EXPECT_EQ(gains.where.line, 7);
}

TEST(StudyHardware, NoIntegralNeedsNoClamp) {
  const Study study = read_text(text_of("{speed: {namespace: crank}}"));
  EXPECT_FALSE(study.hardware.at(0).i_clamp);
  EXPECT_FALSE(study.hardware.at(0).antiwindup);
  EXPECT_TRUE(read_text(kLeastStudy).hardware.empty());
}

TEST(StudyHardware, RefusesWhatNoRobotCouldRead) {
  expect_fault(text_of("{sped: {namespace: a}}"), "hardware.sped", "did you mean \"speed\"", 7);
  expect_fault(text_of("{push: {namespace: a}}"), "hardware.push", "no p, i and d", 7);
  expect_fault(text_of("{speed: {namespce: a}}"), "hardware.speed.namespce", "unknown key", 7);
  expect_fault(text_of("{speed: {}}"), "hardware.speed.namespace", "required key is missing", 7);
  expect_fault(text_of("{speed: {namespace: a//b}}"), "hardware.speed.namespace", "not a namespace", 7);
  expect_fault(text_of("{speed: {namespace: 2a}}"), "hardware.speed.namespace", "not a namespace", 7);
  expect_fault(text_of("{speed: {namespace: /}}"), "hardware.speed.namespace", "not a namespace", 7);
  expect_fault(text_of("{speed: {namespace: a}}", "{p: 1, i: 2}"), "hardware.speed", "limits the integral", 7);
  expect_fault(text_of("{speed: {namespace: a, i_clamp: -1}}"), "hardware.speed.i_clamp", "must not be negative", 7);
  expect_fault(text_of("{speed: {namespace: a, antiwindup: 2}}"), "hardware.speed.antiwindup", "", 7);
}

TEST(StudyHardware, TakesTheClampOfTheController) {
  std::string text = text_of("{speed: {namespace: a}}", "{p: 1, i: 2}, i_clamp: 4, antiwindup: true");
  const HardwareGains gains = read_text(text).hardware.at(0);
  ASSERT_TRUE(gains.i_clamp);
  EXPECT_EQ(gains.i_clamp->nominal(), 4.0);
  EXPECT_TRUE(gains.antiwindup);
  expect_fault(text_of("{speed: {namespace: a, i_clamp: 3}}", "{p: 1, i: 2}, i_clamp: 4"), "hardware.speed.i_clamp", "has i_clamp already",
               7);
}

TEST(StudyHardware, TwoControllersHaveTwoPlaces) {
  const std::string two = "  slow: {type: pid, input: slider_joint/position, setpoint: 0, output: slider_joint, gains: {p: 1}}\n";
  const auto with = [&two](const std::string& hardware) {
    std::string text = text_of(hardware);
    return text.insert(text.find("hardware:"), two);
  };
  EXPECT_EQ(read_text(with("{speed: {namespace: arm/a}, slow: {namespace: arm/ab}}")).hardware.size(), 2U);
  expect_fault(with("{speed: {namespace: arm/a}, slow: {namespace: arm/a}}"), "hardware.slow.namespace", "gains of \"speed\"", 8);
  expect_fault(with("{speed: {namespace: arm/a}, slow: {namespace: arm}}"), "hardware.slow.namespace", "gains of \"speed\"", 8);
}

}  // namespace
}  // namespace codesign
