// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "identification/identify.h"
#include "identification/motion_rig.h"
#include "identification/swinging_arm.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

const std::string kUnfiltered = "  filter: {cutoff: 0}\n";

StudyRecordings both() {
  StudyRecordings recordings;
  recordings.data = {SwingingRig().record("identify.data[0]")};
  SwingingRig other;
  other.offset = 0.3;
  recordings.holdout = {other.record("identify.holdout[0]")};
  return recordings;
}

/// The root mean square of 0.6 a + 0.1 v - (0.8 a + 0.4 v + offset) over the compared samples, by
/// the rig's own formulas; the model's start is an inertia of 0.6 kg m^2 and 0.1 N m s.
double expected_rms(const SwingingRig& rig, const std::vector<double>& times) {
  double sum = 0.0;
  for (const double t : times) {
    const double r = -0.2 * rig.acceleration(t) - 0.3 * rig.velocity(t) - rig.offset;
    sum += r * r;
  }
  return std::sqrt(sum / static_cast<double>(times.size()));
}

TEST(EvaluateModel, HasTheResidualsOfTheModelAsItStands) {
  const Problem problem = swinging_problem("{csv: data.csv}", kUnfiltered);
  const IdentificationResult result = evaluate_model(problem, both(), nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.termination, kEvaluated);
  EXPECT_TRUE(result.numbers.empty());
  ASSERT_EQ(result.data.size(), 1U);
  ASSERT_EQ(result.holdout.size(), 1U);
  // Accelerations are differences of samples.
  EXPECT_NEAR(result.data[0].rms, expected_rms(SwingingRig(), result.data_series.times), 2e-3);
  SwingingRig other;
  other.offset = 0.3;
  EXPECT_NEAR(result.holdout[0].rms, expected_rms(other, result.holdout_series.times), 2e-3);
  EXPECT_EQ(result.data[0].start, result.data[0].rms);
}

TEST(EvaluateModel, OfFittedValuesIsTheFit) {
  StudyRecordings recordings = both();
  for (double& effort : recordings.data[0].joints[0].effort) effort += 0.05 * std::sin(effort);
  const IdentificationResult fit =
      identify(swinging_problem("{csv: data.csv}", kUnfiltered), recordings, {}, nullptr);
  const Problem problem =
      load_problem({"arm.urdf", kSwingingArm}, {},
                   {"study.yaml", swinging_study("{csv: data.csv}", kUnfiltered)},
                   {{"inertia", fit.x[0]}, {"viscous", fit.x[1]}});
  const IdentificationResult judged = evaluate_model(problem, recordings, nullptr);
  EXPECT_NEAR(judged.data[0].rms, fit.data[0].rms, 1e-9 * fit.data[0].rms);
  EXPECT_NEAR(judged.data[0].explained, fit.data[0].explained, 1e-12);
  EXPECT_NEAR(judged.holdout[0].rms, fit.holdout[0].rms, 1e-9 * fit.holdout[0].rms);
}

/// Segments begin at the states that fit best, in an evaluation as in a fit.
TEST(EvaluateModel, OfMotionsIsTheFitToo) {
  MotionRig rig;
  rig.noise = 1e-3;
  StudyRecordings recordings;
  recordings.data = {record_pendulum(rig)};
  const std::string names = "inertia: {}, viscous: {}, dry: {}", blocks = motion_servo();
  const IdentificationResult fit =
      identify(motion_problem(blocks, "", names), recordings, {}, nullptr);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
  std::string values;
  for (const IdentifiedNumber& number : fit.numbers)
    values += (values.empty() ? "" : ", ") + number.name +
              ": {initial: " + to_decimal(number.value) + "}";
  const IdentificationResult judged =
      evaluate_model(motion_problem(blocks, "", values), recordings, nullptr);
  ASSERT_TRUE(judged.status.ok()) << judged.status.cause;
  ASSERT_EQ(judged.data.size(), fit.data.size());
  for (std::size_t k = 0; k < fit.data.size(); ++k) {
    // The recorded effort has no noise: its residuals are the errors of the integration.
    EXPECT_NEAR(judged.data[k].rms, fit.data[k].rms,
                1e-3 * fit.data[k].rms + 1e-8 * fit.data[k].recorded)
        << fit.data[k].joint;
    EXPECT_LT(judged.data[k].rms, 2e-3) << "the noise";
  }
}

TEST(EvaluateModel, TakesAHoldoutAloneAndNothingTuned) {
  const Problem problem = load_problem({"arm.urdf", kSwingingArm}, {},
                                       {"study.yaml", "identify: {filter: {cutoff: 0}}\n"});
  StudyRecordings recordings = both();
  recordings.data.clear();
  const IdentificationResult result = evaluate_model(problem, recordings, nullptr);
  ASSERT_TRUE(result.status.ok());
  EXPECT_TRUE(result.data.empty());
  EXPECT_GT(result.holdout[0].rms, 0.3);
  EXPECT_THROW(evaluate_model(problem, {}, nullptr), InputError);
  EXPECT_THROW(require_identification(problem), InputError);
}

TEST(EvaluateModel, ToldWrongModelsAreNoFailure) {
  StudyRecordings recordings = both();
  for (double& effort : recordings.data[0].joints[0].effort) effort = -effort;
  const IdentificationResult result =
      evaluate_model(swinging_problem("{csv: data.csv}", kUnfiltered), recordings, nullptr);
  EXPECT_TRUE(result.status.ok());
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_EQ(result.warnings[0].code, "effort_not_explained");
  EXPECT_NE(result.warnings[0].message.find("the model explains"), std::string::npos)
      << result.warnings[0].message;
}

TEST(EvaluateModel, IsCancelled) {
  const std::atomic<bool> cancel{true};
  const IdentificationResult result = evaluate_model(swinging_problem(), both(), &cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_TRUE(result.data.empty());
}

}  // namespace
}  // namespace codesign
