// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/recorded_run.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "mechanism_codesign/error.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

TEST(CheckRecording, RefusesWhatMemoryOrRosTimeCannotHold) {
  const auto fault_of = [](double duration, double rate) -> std::string {
    Study study = pendulum().study();
    study.duration = duration;
    const Problem problem = with_study(pendulum(), study);
    try {
      check_recording(problem, rate, "/optimization/rate");
      return "";
    } catch (const InputError& error) {
      return error.fault().element;
    }
  };
  EXPECT_EQ(fault_of(0.5, 50.0), "");
  EXPECT_EQ(fault_of(3600.0, 50.0), "");
  EXPECT_EQ(fault_of(1e9, 1e10), "rate");
  EXPECT_EQ(fault_of(0.5, 1e300), "rate");
  EXPECT_EQ(fault_of(1e5, 1e4), "rate");
  EXPECT_EQ(fault_of(5e9, 1e-6), "duration");
}

TEST(CheckRecording, AStudyWithScenariosRecordsTwiceAsManyRuns) {
  const auto fits = [](const std::string& ensemble, double rate) {
    try {
      check_recording(block(ensemble), rate, "rate");
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  double rate = 1.0;
  while (fits("", 1.1 * rate)) rate *= 1.1;
  EXPECT_FALSE(fits("runs: {a: {}}\n", rate));
  EXPECT_TRUE(fits("runs: {a: {}}\n", 0.49 * rate));
}

}  // namespace
}  // namespace codesign
