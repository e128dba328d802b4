// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/geared_arm.h"

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace codesign {

std::string geared_study(const std::string& data) {
  return R"(duration: 60.0
controllers:
  s1: {type: pid, input: shoulder/position, setpoint: {type: sine, amplitude: 1.2, frequency: 0.31}, output: shoulder, gains: {p: 900.0, d: 80.0}}
  s2: {type: pid, input: elbow/position, setpoint: {type: sine, amplitude: 1.1, frequency: 0.47, phase: 0.5}, output: elbow, gains: {p: 300.0, d: 25.0}}
solver: {relative_tolerance: 1.0e-8, absolute_tolerance: 1.0e-9}
parameters: {efficiency: {}, motor_coulomb: {}, motor_viscous: {}, coulomb: {}, viscous: {}, exponent: {}}
identify:
  data: [)" +
         data + R"(]
  filter: {cutoff: 60.0, residual_cutoff: 20.0, decimate: 5}
optimizer: {algorithm: levenberg_marquardt, relative_tolerance: 1.0e-10}
)";
}

void add_gear_noise(double deviation, unsigned seed, std::vector<double>* values) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  for (double& value : *values) value += normal(random);
}

JointRecording with_noise(JointRecording recording, unsigned seed) {
  for (JointSamples& joint : recording.joints) {
    add_gear_noise(1e-5, seed++, &joint.position);
    add_gear_noise(0.5, seed++, &joint.effort);
  }
  return recording;
}

Problem geared_problem(const std::string& data) {
  return load_problem({"arm.urdf", kGearedArm}, {}, {"study.yaml", geared_study(data)});
}

JointRecording clean_geared_recording() {
  return record_run(geared_problem(), kGearedTruth, {"shoulder", "elbow"}, 500.0);
}

std::pair<double, double> gear_friction(const std::map<std::string, double>& numbers,
                                        double speed) {
  return {80.0 * (numbers.at("motor_coulomb") + 80.0 * speed * numbers.at("motor_viscous")),
          numbers.at("coulomb") + numbers.at("viscous") * std::pow(speed, numbers.at("exponent"))};
}

void expect_geared_truth(const std::map<std::string, double>& found, const std::string& what) {
  EXPECT_NEAR(found.at("efficiency"), kGearedTruth.at("efficiency"), 0.01) << what;
  for (const auto& [name, truth] : kGearedTruth)
    EXPECT_NEAR(found.at(name) / truth, 1.0, 0.05) << what << ", " << name;
  for (const double speed : {0.3, 0.6, 1.2, 2.3}) {
    const auto [motor, elbow] = gear_friction(found, speed);
    const auto [true_motor, true_elbow] = gear_friction(kGearedTruth, speed);
    EXPECT_NEAR(motor / true_motor, 1.0, 0.03) << what << ", shoulder at " << speed;
    EXPECT_NEAR(elbow / true_elbow, 1.0, 0.03) << what << ", elbow at " << speed;
  }
}

}  // namespace codesign
