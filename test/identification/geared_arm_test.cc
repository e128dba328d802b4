// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The losses of gears and friction in N m found from motors alone: noisy positions and efforts.
#include "identification/geared_arm.h"

#include <cmath>

#include "engine/thread_engine.h"
#include "identification/identify.h"

namespace codesign {
namespace {

/// Simulated once for all tests.
const JointRecording& clean_recording() {
  static const JointRecording kClean = clean_geared_recording();
  return kClean;
}

TEST(GearedArm, EfficiencyAndFrictionFromMotorsAlone) {
  const Problem problem = geared_problem();
  const JointRecording& clean = clean_recording();
  side_by_side(10, 2, [&](std::size_t run) {
    const unsigned seed = 3 + 4 * static_cast<unsigned>(run);
    StudyRecordings recordings;
    recordings.data = {with_noise(clean, seed)};
    const IdentificationResult result = identify(problem, recordings, {}, nullptr);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    ASSERT_EQ(result.numbers.size(), kGearedTruth.size());
    std::map<std::string, double> found;
    for (const IdentifiedNumber& number : result.numbers) {
      found[number.name] = number.value;
      EXPECT_TRUE(number.is_determined) << number.name;
    }
    expect_geared_truth(found, "seed " + std::to_string(seed));
  });
}

TEST(GearedArm, WithoutTheGearTheLossesAreNotExplained) {
  const Problem problem = geared_problem();
  std::string other = geared_study();
  other.replace(other.find("efficiency: {}, "), 16, "efficiency: {tune: false, initial: 1.0}, ");
  const Problem without = load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", other});
  StudyRecordings recordings;
  recordings.data = {clean_recording()};
  const IdentificationResult with_gear = identify(problem, recordings, {}, nullptr),
                             without_gear = identify(without, recordings, {}, nullptr);
  ASSERT_TRUE(with_gear.status.ok()) << with_gear.status.cause;
  ASSERT_TRUE(without_gear.status.ok()) << without_gear.status.cause;
  EXPECT_GT(without_gear.data[0].rms, 5.0 * with_gear.data[0].rms);
}

}  // namespace
}  // namespace codesign
