// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/recorded_run.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "mechanism_codesign/error.h"
#include "ros/pendulum.h"
#include "ros/sample_frame.h"

namespace codesign {
namespace {

RecordedRun sample_run(double force) {
  RecordedRun run{sample_names(), {sample_frame(0.0), sample_frame(0.1)}, {}};
  run.frames[1].frictions[0].force = {0.0, force, 0.0};
  return run;
}

TEST(LayOut, TheMechanismsStandClearOfEachOther) {
  // The sample's links span 1 m along x and 2 m along y.
  EXPECT_DOUBLE_EQ(lay_out(sample_run(1.0), sample_run(1.0)).separation, 2.0 + 0.5 * 2.0);
}

TEST(LayOut, ATypicalArrowOfBothRunsIsAThirdOfTheMechanism) {
  // Forces of 4, 3, 4 and 5 N, whose mean square is 16.5; torques of 2 N m throughout.
  const SceneLayout layout = lay_out(sample_run(3.0), sample_run(5.0));
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton * std::sqrt(16.5), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton_metre * 2.0, 2.0 / 3.0);
}

TEST(LayOut, TheArrowOfAPeakIsNotLongerThanTheMechanism) {
  RecordedRun peaked = sample_run(1e3);
  peaked.frames.resize(100, sample_frame(0.0));
  EXPECT_DOUBLE_EQ(lay_out(sample_run(3.0), peaked).style.metres_per_newton * 1e3, 2.0);
}

TEST(LayOut, WithoutFramesItStaysFinite) {
  const SceneLayout layout = lay_out({}, {});
  EXPECT_GT(layout.style.shaft_diameter, 0.0);
  EXPECT_TRUE(std::isfinite(layout.style.metres_per_newton));
}

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
