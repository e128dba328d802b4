// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/recorded_run.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

TEST(CheckRecording, RefusesWhatMemoryOrRosTimeCannotHold) {
  const auto fault_of = [](double duration, double rate) -> std::string {
    Study study = study_of(pendulum());
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

TEST(Advance, AsksOnTheWayAndStops) {
  const Problem problem = pendulum();
  Simulation simulation = simulation_of(system_of(problem), problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  int asked = 0;
  EXPECT_EQ(advance(&simulation, 0.0, 0.5, [&] { return ++asked == 5; }).code,
            StatusCode::kCancelled);
  EXPECT_EQ(asked, 5);
}

TEST(Advance, ChangesNoStepOfTheRun) {
  const Problem problem = pendulum();
  Simulation sliced = simulation_of(system_of(problem), problem.parameters()),
             whole = simulation_of(system_of(problem), problem.parameters());
  Frame from_sliced, from_whole;
  ASSERT_TRUE(sliced.start().ok() && whole.start().ok());
  ASSERT_TRUE(advance(&sliced, 0.0, 0.5, [] { return false; }).ok() && whole.advance(0.5).ok());
  sliced.sample(0.5, &from_sliced);
  whole.sample(0.5, &from_whole);
  EXPECT_EQ(from_sliced.joints[0].position, from_whole.joints[0].position);
  EXPECT_EQ(sliced.statistics().steps, whole.statistics().steps);
}

}  // namespace
}  // namespace codesign
