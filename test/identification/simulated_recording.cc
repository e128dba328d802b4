// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/simulated_recording.h"

#include <map>
#include <string>
#include <vector>

namespace codesign {

JointRecording record_run(const Problem& problem, const std::map<std::string, double>& truth,
                          const std::vector<std::string>& joints, double rate) {
  std::vector<double> parameters;
  for (const Parameter& parameter : study_of(problem).parameters) {
    const auto found = truth.find(parameter.name);
    parameters.push_back(found == truth.end() ? parameter.value : found->second);
  }
  std::vector<std::string> signals;
  JointRecording recording;
  recording.file = "run.csv";
  recording.element = "identify.data[0]";
  recording.where = {"study.yaml", 2};
  for (const std::string& joint : joints) {
    signals.push_back(joint + "/position");
    signals.push_back(joint + "/effort");
    recording.joints.push_back({joint, {}, {}, {}});
  }
  Simulation simulation(problem, parameters, signals);
  const double duration = study_of(problem).duration;
  const Status status = simulate(&simulation, duration, static_cast<int>(duration * rate + 0.5) + 1,
                                 [&](const Frame& frame) {
                                   recording.times.push_back(frame.time);
                                   recording.places.push_back(recording.times.size() + 1);
                                   for (std::size_t k = 0; k < joints.size(); ++k) {
                                     recording.joints[k].position.push_back(frame.signals[2 * k]);
                                     recording.joints[k].effort.push_back(frame.signals[2 * k + 1]);
                                   }
                                   return true;
                                 });
  EXPECT_TRUE(status.ok()) << status.cause;
  return recording;
}

}  // namespace codesign
