// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/comparison/model_comparison.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>

#include "engine/thread_engine.h"
#include "identification/identify.h"
#include "identification/swinging_arm.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

JudgedModel model(std::vector<std::string> numbers, double first, double second) {
  JudgedModel model;
  model.rank = static_cast<int>(numbers.size());
  model.numbers = std::move(numbers);
  model.inflation = 4.0;
  model.samples = 200;
  model.data = {{"a", 2.0, first, 0.9}, {"b", 3.0, second, 0.9}};
  return model;
}

TEST(ModelComparison, IsThatOfTheFormulas) {
  const JudgedModel small = model({"mass"}, 0.11, 0.21),
                    large = model({"mass", "viscous", "offset"}, 0.10, 0.20);
  const double ratio = 200.0 * 2.0 * (std::log(0.11 / 0.10) + std::log(0.21 / 0.20)) / 4.0;
  const ModelComparison there = compare_models(small, large), back = compare_models(large, small);
  for (const ModelComparison& comparison : {there, back}) {
    EXPECT_TRUE(comparison.refusal.empty());
    EXPECT_TRUE(comparison.is_nested);
    EXPECT_EQ(comparison.degrees, 2);
    EXPECT_NEAR(comparison.statistic, ratio, 1e-12);
    // A chi-squared variable of two degrees of freedom is exponential.
    EXPECT_NEAR(comparison.probability, std::exp(-ratio / 2.0), 1e-12);
  }
  EXPECT_NEAR(there.criterion, 4.0 - ratio, 1e-12);
  EXPECT_NEAR(back.criterion, ratio - 4.0, 1e-12);
  EXPECT_TRUE(there.is_here_larger);
  EXPECT_FALSE(back.is_here_larger);
}

TEST(ModelComparison, OfOtherNumbersHasACriterionAlone) {
  const ModelComparison comparison =
      compare_models(model({"mass"}, 0.11, 0.2), model({"gain", "lag"}, 0.1, 0.2));
  EXPECT_TRUE(comparison.refusal.empty());
  EXPECT_FALSE(comparison.is_nested);
}

TEST(ModelComparison, IsRefusedWhereThereIsNoLikelihood) {
  const JudgedModel right = model({"mass"}, 0.11, 0.2);
  JudgedModel other = right;
  other.samples = 100;
  EXPECT_EQ(compare_models(other, right).refusal, "the two were judged on different data");
  other = right;
  other.data[1].recorded = 3.1;
  EXPECT_EQ(compare_models(right, other).refusal, "the two were judged on different data");
  other = right;
  other.has_rest_bounds = true;
  EXPECT_NE(compare_models(other, right).refusal.find("bounds"), std::string::npos);
  EXPECT_NE(compare_models(right, other).refusal.find("bounds"), std::string::npos);
  other = right;
  other.is_squares = false;
  EXPECT_NE(compare_models(other, right).refusal, "");
  other = right;
  other.data[0].rms = 0.0;
  EXPECT_EQ(compare_models(other, right).refusal, "residuals are zero");
  other = right;
  other.data.clear();
  EXPECT_NE(compare_models(right, other).refusal, "");
}

JudgedModel judged(const IdentificationResult& result) {
  JudgedModel model;
  for (const IdentifiedNumber& number : result.numbers) model.numbers.push_back(number.name);
  model.rank = result.rank;
  model.inflation = result.inflation;
  model.samples = result.samples;
  for (const OutputFit& fit : result.data)
    model.data.push_back({fit.joint, fit.recorded, fit.rms, fit.explained});
  return model;
}

/// In how many of `runs` an offset that is zero is found with a probability below 5 %, of noise
/// whose neighbours have a correlation of 0.9. @param is_white leaves the inflation out
double false_alarms(int runs, bool is_white) {
  const Problem small = swinging_problem(),
                large = swinging_problem("{csv: data.csv}", "  joints: {hinge: {offset: {}}}\n");
  const JointRecording clean = SwingingRig().record("identify.data[0]");
  std::atomic<int> alarms{0};
  side_by_side(static_cast<std::size_t>(runs), 2, [&](std::size_t run) {
    StudyRecordings recordings;
    recordings.data = {clean};
    std::mt19937 random(static_cast<unsigned>(run) + 1);
    std::normal_distribution<double> normal;
    double error = 0.1 * normal(random);
    for (double& effort : recordings.data[0].joints[0].effort) {
      effort += error;
      error = 0.9 * error + std::sqrt(1.0 - 0.81) * 0.1 * normal(random);
    }
    JudgedModel few = judged(identify(small, recordings, {}, nullptr)),
                more = judged(identify(large, recordings, {}, nullptr));
    if (is_white) more.inflation = 1.0;
    const ModelComparison comparison = compare_models(few, more);
    EXPECT_TRUE(comparison.is_nested) << comparison.refusal;
    alarms += comparison.probability < 0.05 ? 1 : 0;
  });
  return static_cast<double>(alarms) / runs;
}

TEST(ModelComparison, FindsNumbersThatAreNotNeededAsSeldomAsItSays) {
  constexpr int kRuns = 200;
  const double share = false_alarms(kRuns, false);
  RecordProperty("share", std::to_string(share));
  EXPECT_GE(share, 0.01);
  EXPECT_LE(share, 0.12);
  EXPECT_GT(false_alarms(50, true), 0.3) << "without the inflation the test would see nothing";
}

}  // namespace
}  // namespace codesign
