// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The inertias of a whole arm, of which a recording determines little more than half.
#include <gtest/gtest.h>

#include <random>

#include "description/study.h"
#include "identification/identify.h"
#include "identification/simulated_recording.h"
#include "jobs/identification_records.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const std::vector<std::string>& joints() {
  static const std::vector<std::string> names{"shoulder_pan_joint", "shoulder_lift_joint",
                                              "elbow_joint",        "wrist_1_joint",
                                              "wrist_2_joint",      "wrist_3_joint"};
  return names;
}

/// Ten numbers of each of six links, and two of the friction of each of six joints.
std::vector<std::string> sought() {
  std::vector<std::string> names;
  for (const char* link : {"shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link",
                           "wrist_2_link", "wrist_3_link"})
    for (const char* number : {"alpha", "d1", "d2", "d3", "s12", "s23", "s13", "t1", "t2", "t3"})
      names.push_back(std::string(link) + "_" + number);
  for (const std::string& joint : joints())
    for (const char* number : {"coulomb", "viscous"})
      names.push_back(joint.substr(0, joint.size() - 5) + number);
  return names;
}

/// The shipped arm with free inertias in all links; its flange, a plate without thickness, gets
/// some.
Problem arm() {
  const std::string root = source_dir();
  SourceText overlay = read_source(root + "/urdf/overlays/vendor_arm.urdf");
  std::string free;
  for (const char* link : {"shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link",
                           "wrist_2_link", "wrist_3_link"})
    free += std::string("<link name=\"") + link + "\"><inertial codesign:inertia=\"free\"/></link>";
  overlay.text.insert(overlay.text.rfind("</robot>"), free);
  SourceText study = read_source(root + "/config/vendor_arm.yaml");
  const std::size_t begin = study.text.find("parameters:\n"), end = study.text.find("objective:\n");
  std::string tuned = "parameters:\n";
  for (const std::string& name : sought()) tuned += "  " + name + ": {tune: true}\n";
  study.text.replace(begin, end - begin, tuned);
  SourceText urdf = read_source(root + "/urdf/vendor_arm.urdf");
  const std::string plate = "izz=\"0.0002\"";
  urdf.text.replace(urdf.text.rfind(plate), plate.size(), "izz=\"0.00015\"");
  return load_problem(urdf, {overlay}, study);
}

/// Other masses, centres, moments and frictions than those of the file.
std::map<std::string, double> truth(const Problem& problem) {
  std::map<std::string, double> values;
  int k = 0;
  for (const std::string& name : sought()) {
    const auto& all = study_of(problem).parameters;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&name](const Parameter& one) { return one.name == name; });
    const double sign = ++k % 2 == 0 ? 1.0 : -1.0;
    const std::string kind = name.substr(name.rfind('_') + 1);
    const bool is_friction = kind == "coulomb" || kind == "viscous",
               is_logarithm = kind == "alpha" || kind[0] == 'd';
    values[name] = is_friction ? found->value * (1.0 + 0.3 * sign)
                               : found->value + sign * (is_logarithm ? 0.1 : 0.01);
  }
  return values;
}

/// A recording whose efforts have the noise of a current sensor, half a percent of their root mean
/// square.
JointRecording recorded(const Problem& problem) {
  JointRecording recording = record_run(problem, truth(problem), joints(), 100.0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (JointSamples& joint : recording.joints) {
    const Eigen::Map<Eigen::VectorXd> effort(joint.effort.data(),
                                             static_cast<Eigen::Index>(joint.effort.size()));
    const double noise =
        0.005 * std::sqrt(effort.squaredNorm() / static_cast<double>(effort.size()));
    for (double& sample : joint.effort) sample += noise * normal(random);
  }
  return recording;
}

TEST(FreeInertiaFit, EndsWithinTwelveEvaluations) {
  const Problem problem = arm();
  StudyRecordings recordings;
  recordings.data = {recorded(problem)};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  bool is_told = false;
  for (const std::string& sentence : identification_sentences(result)) {
    EXPECT_LE(sentence.size(), 200U) << sentence;
    is_told = is_told || sentence.find("; the prior decides the other ") != std::string::npos;
  }
  EXPECT_TRUE(is_told);
  EXPECT_EQ(result.numbers.size(), 72U);
  EXPECT_LT(result.rank, 72);
  EXPECT_FALSE(result.combinations.empty());
  EXPECT_LE(result.evaluations, 12);
  ASSERT_EQ(result.data.size(), 6U);
  for (const OutputFit& joint : result.data) {
    EXPECT_LT(joint.rms, 0.005 * joint.recorded) << joint.joint << ": not more than the noise";
    EXPECT_LT(joint.rms, 0.1 * joint.start) << joint.joint;
  }
}

}  // namespace
}  // namespace codesign
