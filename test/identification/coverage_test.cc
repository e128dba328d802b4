// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Whether 95 % intervals hold the truth in 95 % of many runs with correlated noise, through the
// whole identification.
#include <cmath>
#include <mutex>
#include <random>

#include "engine/thread_engine.h"
#include "identification/fit/fit_variables.h"
#include "identification/identify.h"
#include "identification/simulated_recording.h"

namespace codesign {
namespace {

constexpr const char* kSwing =
    R"(<robot name="swing" xmlns:codesign="https://mechanism-codesign.org">
  <codesign:parameter name="mass" value="1.5"/><codesign:parameter name="viscous" value="0.1"/>
  <codesign:parameter name="mu_static" value="0.3"/><codesign:parameter name="mu_dynamic" value="0.2"/>
  <link name="base"/>
  <link name="bar"><inertial><origin xyz="0 0 -0.4"/><mass value="1.5" codesign:value="${mass}"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" codesign:mu_static="${mu_static}" codesign:mu_dynamic="${mu_dynamic}" viscous="0.1"
      codesign:viscous="${viscous}" transition_velocity="0.02" joint_length="0.1" pin_radius="0.05"/></joint>
</robot>)";

std::string swing_study(const std::string& noise) {
  return R"(duration: 20.0
controllers:
  servo:
    type: pid
    input: hinge/position
    setpoint: {type: waypoints, interpolation: quintic, times: [0.0, 1.5, 2.5, 4.5, 5.5, 7.0, 9.5, 10.5, 12.0, 14.5, 16.0, 17.0, 20.0],
               positions: [0.0, 0.9, 0.2, -0.8, 0.5, 1.1, -0.4, 0.3, -1.0, 0.6, -0.2, 0.4, 0.0]}
    output: hinge
    gains: {p: 60.0, d: 6.0}
identify:
  data: [{csv: run.csv}]
  filter: {cutoff: 30.0, residual_cutoff: 15.0, decimate: 2}
  joints: {hinge: {offset: {}}}
  intervals: {noise: )" +
         noise + R"(}
parameters: {mass: {}, viscous: {}, mu_static: {}, mu_dynamic: {}}
optimizer: {algorithm: levenberg_marquardt}
)";
}

/// In how many of `runs` each interval holds the truth.
std::map<std::string, double> coverage(const std::string& noise, int runs) {
  const std::map<std::string, double> truth = {{"mass", 2.0},
                                               {"viscous", 0.3},
                                               {"mu_static", 0.4},
                                               {"mu_dynamic", 0.25},
                                               {"hinge/offset", 0.0}};
  const Problem problem =
      load_problem({"swing.urdf", kSwing}, {}, {"study.yaml", swing_study(noise)});
  const JointRecording clean = record_run(problem, truth, {"hinge"}, 100.0);
  std::map<std::string, double> held;
  std::mutex mutex;
  side_by_side(static_cast<std::size_t>(runs), 2, [&](std::size_t run) {
    StudyRecordings recordings;
    recordings.data = {clean};
    std::mt19937 random(static_cast<unsigned>(run) + 1000);
    std::normal_distribution<double> normal;
    constexpr double kCorrelation = 0.9, kDeviation = 0.2;
    double error = kDeviation * normal(random);
    for (double& effort : recordings.data[0].joints[0].effort) {
      effort += error;
      error = kCorrelation * error +
              std::sqrt(1.0 - kCorrelation * kCorrelation) * kDeviation * normal(random);
    }
    const IdentificationResult result = identify(problem, recordings, {}, nullptr);
    EXPECT_TRUE(result.status.ok()) << result.status.cause;
    const std::lock_guard<std::mutex> lock(mutex);
    for (const IdentifiedNumber& number : result.numbers)
      held[number.name] +=
          number.low <= truth.at(number.name) && truth.at(number.name) <= number.high ? 1.0 / runs
                                                                                      : 0.0;
  });
  return held;
}

TEST(IntervalCoverage, HoldsForCorrelatedNoise) {
  const std::map<std::string, double> held = coverage("correlated", 200);
  ASSERT_EQ(held.size(), 5U);
  double all = 0.0;
  for (const auto& [name, share] : held) {
    RecordProperty(name, std::to_string(share));
    EXPECT_GE(share, 0.92) << name;
    EXPECT_LT(share, 1.0) << name << ": an interval that always holds the truth is too wide";
    all += share / static_cast<double>(held.size());
  }
  EXPECT_GE(all, 0.92);
  EXPECT_LE(all, 0.98);
}

TEST(IntervalCoverage, IsFarFromPromisedIfTheNoiseIsTakenForWhite) {
  for (const auto& [name, share] : coverage("white", 50)) EXPECT_LT(share, 0.85) << name;
}

/// Fits of a delay of 12 ms to efforts with white noise, at 100 Hz.
struct DelayFits {
  DelayFits(const std::string& filter, const std::string& intervals, double noise, int runs) {
    std::string study = swing_study(intervals);
    const std::string old =
        "  filter: {cutoff: 30.0, residual_cutoff: 15.0, decimate: 2}\n  joints: {hinge: {offset: "
        "{}}}\n";
    study.replace(
        study.find(old), old.size(),
        "  filter: {" + filter + "}\n  joints: {hinge: {delay: {lower: 0, upper: 0.05}}}\n");
    const Problem problem = load_problem({"swing.urdf", kSwing}, {}, {"study.yaml", study});
    constexpr double kDelay = 0.012;
    JointRecording clean = record_run(problem, {}, {"hinge"}, 100.0);
    const RecordedEffort effort(clean.times, clean.joints[0].effort);
    double squares = 0.0, sum = 0.0;
    for (int run = 0; run < runs; ++run) {
      StudyRecordings recordings;
      recordings.data = {clean};
      std::mt19937 random(static_cast<unsigned>(run) + 1);
      std::normal_distribution<double> normal;
      for (std::size_t k = 0; k < clean.times.size(); ++k)
        recordings.data[0].joints[0].effort[k] =
            effort.at(clean.times[k] - kDelay).value + noise * normal(random);
      const IdentificationResult result = identify(problem, recordings, {}, nullptr);
      EXPECT_TRUE(result.status.ok()) << result.status.cause;
      const IdentifiedNumber& delay = result.numbers.back();
      EXPECT_EQ(delay.name, "hinge/delay");
      stated += delay.deviation / runs;
      signal += delay.slope_signal / runs;
      sum += (delay.value - kDelay) / runs;
      squares += (delay.value - kDelay) * (delay.value - kDelay) / runs;
      for (const Warning& warning : result.warnings)
        warned += warning.code == "delay_in_noise" ? 1 : 0;
    }
    bias = sum;
    error = std::sqrt(squares - sum * sum);
    RecordProperty("bias", std::to_string(bias));
    RecordProperty("stated", std::to_string(stated));
    RecordProperty("error", std::to_string(error));
    RecordProperty("signal", std::to_string(signal));
  }
  static void RecordProperty(const std::string& key, const std::string& value) {
    testing::Test::RecordProperty(key, value);
  }

  double stated = 0.0, signal = 0.0;  ///< means
  double bias = 0.0, error = 0.0;  ///< mean and standard deviation of the errors of the delays [s]
  int warned = 0;
};

TEST(IntervalCoverage, NoiseThatMakesUpTheSlopeOfADelayIsTold) {
  const DelayFits fits("cutoff: 0", "white", 0.6, 20);
  EXPECT_LT(fits.signal, 0.6);
  EXPECT_EQ(fits.warned, 20);
  EXPECT_GT(fits.stated, 0.7 * fits.error) << "bias " << fits.bias;
}

TEST(IntervalCoverage, AFilterOfTheResidualLeavesTheSlopeItsSignal) {
  const DelayFits fits("cutoff: 0, residual_cutoff: 5.0, decimate: 5", "correlated", 0.2, 40);
  EXPECT_GT(fits.signal, 0.8);
  EXPECT_EQ(fits.warned, 0);
  EXPECT_GT(fits.stated, 0.7 * fits.error) << "bias " << fits.bias;
  EXPECT_LT(fits.stated, 1.6 * fits.error);
}

}  // namespace
}  // namespace codesign
