// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Numbers that only move the instants at which a load switches are found from the motion.

#include "identification/identify.h"
#include "identification/simulated_recording.h"
#include "paths.h"

namespace codesign {
namespace {

/// The trolley of test/features/switches.yaml with other starting values.
Problem trolley() {
  return load_problem(
      read_source(source_dir() + "/test/features/switches.urdf"), {},
      {"study.yaml",
       "duration: 3.0\ninitial_state: {slide: {velocity: 0.4}, swing: {position: 0.3}}\n"
       "parameters: {ts: {initial: 0.36, lower: 0.2, upper: 0.6}, push: {initial: 2.7, lower: 1, "
       "upper: 6}, gap: {initial: 0.22, lower: 0.1, upper: 0.4}, length: {}, k: {initial: 50, "
       "lower: 20, upper: 100}}\n"
       "loads:\n"
       "  - {joint: slide, effort: \"${t < ts ? push : -0.5*push}\"}\n"
       "  - {joint: slide, effort: \"${-k*max(0, slide/position - gap)}\"}\n"
       "  - {joint: swing, effort: \"${swing/position > 0.1 ? -0.1 : 0.1}\"}\n"
       "identify: {data: [{csv: run.csv}], residual: motion, segment: 1.0}\n"});
}

TEST(SwitchedMotion, ItsInstantsAreIdentified) {
  const std::map<std::string, double> truth = {
      {"ts", 0.31}, {"push", 3.0}, {"gap", 0.2}, {"length", 0.4}, {"k", 60.0}};
  const Problem problem = trolley();
  StudyRecordings recordings;
  recordings.data = {record_run(problem, truth, {"slide", "swing"}, 100.0)};
  const IdentificationResult found = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  ASSERT_EQ(found.numbers.size(), truth.size());
  for (const IdentifiedNumber& number : found.numbers)
    EXPECT_NEAR(number.value, truth.at(number.name), 1e-6 * truth.at(number.name)) << number.name;
}

}  // namespace
}  // namespace codesign
