// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/segment_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "description/study.h"
#include "identification/motion/segments.h"
#include "identification/motion_rig.h"
#include "math/differences.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

// Steps of one size at all designs, so that a run is a smooth function of its numbers.
constexpr const char* kEqualSteps =
    "solver: {method: rodas4, relative_tolerance: 0.99, absolute_tolerance: 0.99, initial_step: "
    "0.0025, maximum_step: 0.0025}\n";

JointRecording wavy(const std::string& joint, double effort) {
  JointRecording recording;
  JointSamples samples{joint, {}, {}, {}};
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.01 * k;
    recording.times.push_back(t);
    samples.position.push_back(0.4 + 0.3 * std::sin(4.0 * t));
    samples.velocity.push_back(1.2 * std::cos(4.0 * t));
    samples.effort.push_back(effort * (0.1 + 0.5 * std::sin(9.0 * t) + 0.2 * std::cos(31.0 * t)));
  }
  recording.joints = {samples};
  return recording;
}

/// A segment of a mechanism, and the derivatives of its simulated outputs.
struct Prepared {
  Prepared(const Problem& problem, const std::string& joint, double effort)
      : recording(wavy(joint, effort)),
        variables(study_of(problem)),
        joints{{joint, true, 1.0, {}}},
        outputs(motion_outputs(*system_of(problem), joints, {recording})),
        of(make_segment_system(*system_of(problem), variables, joints, {joint}, outputs,
                               recording)) {
    Warnings warnings;
    std::vector<Segment> segments = cut_into_segments(recording, of, variables, {joint},
                                                      *study_of(problem).identification, &warnings);
    EXPECT_TRUE(set_branches(recording, of, *system_of(problem), variables, variables.start(),
                             {joint}, nullptr, &segments)
                    .ok());
    segment = segments.at(1);
    at = of.parameters(variables, variables.start(), segment.start);
  }

  JointRecording recording;
  FitVariables variables;
  std::vector<MeasuredJoint> joints;
  std::vector<MotionOutput> outputs;
  SegmentSystem of;
  Segment segment;
  std::vector<double> at;
};

/// Compares the derivatives of the last sample, and one before, with differences.
void expect_exact_slopes(const Prepared& p) {
  SegmentRun run(p.of, p.segment.begin);
  const Status status = run.run(p.at, p.segment.begin, p.segment.times);
  ASSERT_TRUE(status.ok()) << status.cause;
  const Eigen::MatrixXd slopes = run.slopes();
  const std::vector<int>& tuned = p.of.system->study().tuned;
  ASSERT_EQ(slopes.cols(), static_cast<Eigen::Index>(tuned.size()));
  const Eigen::Index rows = run.values().rows();
  for (std::size_t k = 0; k < tuned.size(); ++k) {
    const auto index = static_cast<std::size_t>(tuned[k]);
    for (Eigen::Index output = 0; output < run.values().cols(); ++output)
      for (Eigen::Index row : {rows / 2, rows - 1}) {
        const auto value = [&](double x) {
          std::vector<double> moved = p.at;
          moved[index] = x;
          EXPECT_TRUE(run.run(moved, p.segment.begin, p.segment.times).ok());
          return run.values()(row, output);
        };
        const double slope = slopes(output * rows + row, static_cast<Eigen::Index>(k));
        const RiddersDerivative expected =
            ridders_derivative(value, p.at[index], 1e-3 * std::max(0.05, std::abs(p.at[index])));
        EXPECT_NEAR(slope, expected.value,
                    5e-9 * (1.0 + std::abs(expected.value)) + 3.0 * expected.error)
            << p.of.system->study().parameters[index].name << ", "
            << p.outputs[static_cast<std::size_t>(output)].name() << ", sample " << row;
        EXPECT_LT(expected.error, 1e-8 * (1.0 + std::abs(expected.value)));
      }
  }
  EXPECT_GT(slopes.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-6)
      << "a number without effect tests nothing";
}

TEST(SegmentRun, DerivativesUnderARecordedEffortAreExact) {
  const Problem problem = motion_problem(
      kEqualSteps,
      "  segment: 0.4\n  joints: {hinge: {effort_scale: {initial: 2.0}, delay: {initial: 0.003}, "
      "offset: {initial: 0.1}}}\n",
      "inertia: {}, viscous: {}, dry: {}");
  Prepared p(problem, "hinge", 1.0);
  ASSERT_EQ(p.of.columns.size(), 6U);
  ASSERT_EQ(p.of.starts, 2);
  ASSERT_EQ(p.outputs.size(), 2U) << "position and velocity; the effort drives";
  p.at[4] += 0.0007;  // no stage of a step stands at a sample then, where the second derivative of
                      // the effort jumps
  expect_exact_slopes(p);
}

TEST(SegmentRun, DerivativesWithAControllerInTheLoopAreExactIntegralIncluded) {
  const Problem problem =
      motion_problem(kEqualSteps + motion_servo(), "  segment: 0.4\n", "inertia: {}, viscous: {}");
  const Prepared p(problem, "hinge", 1.0);
  ASSERT_EQ(p.of.starts, 3);
  ASSERT_EQ(p.outputs.size(), 3U) << "position, velocity and the controller's effort";
  expect_exact_slopes(p);
}

TEST(SegmentRun, DerivativesOfALoopWithFrictionAreExact) {
  const Problem problem = load_problem(
      read_source(source_dir() + "/urdf/slider_crank.urdf"), {},
      {"study.yaml",
       std::string(kEqualSteps) +
           "initial_state: {crank_joint: {position: 0.0}}\nidentify:\n  data: [{csv: data.csv}]\n"
           "  residual: motion\n  segment: 0.4\nparameters: {crank_length: {}, rod_length: {}}\n"});
  expect_exact_slopes(Prepared(problem, "crank_joint", 0.02));
}

TEST(SegmentRun, NoBitDependsOnEarlierRuns) {
  const Problem problem =
      motion_problem(motion_servo(), "  segment: 0.4\n", "inertia: {}, viscous: {}");
  const Prepared p(problem, "hinge", 1.0);
  SegmentRun fresh(p.of, p.segment.begin), used(p.of, p.segment.begin);
  std::vector<double> other = p.at;
  other[0] *= 3.0;
  ASSERT_TRUE(used.run(other, p.segment.begin, p.segment.times).ok());
  ASSERT_TRUE(used.run(p.at, p.segment.begin, p.segment.times).ok());
  ASSERT_TRUE(fresh.run(p.at, p.segment.begin, p.segment.times).ok());
  EXPECT_EQ(fresh.values(), used.values());
  EXPECT_EQ(fresh.slopes(), used.slopes());
}

TEST(SegmentRun, NoBitDependsOnWhatARunCarries) {
  // Nine parameters and three numbers of the start: two groups of lanes; the start needs one of
  // them.
  std::string robot = motion_pendulum(), sum = "viscous", declared,
              tuned = "inertia: {}, viscous: {}, dry: {}";
  for (const char* name : {"v1", "v2", "v3", "v4", "v5", "v6"}) {
    sum += std::string(" + ") + name;
    declared += std::string("  <codesign:parameter name=\"") + name +
                "\" value=\"0\" lower=\"0\" upper=\"1\"/>\n";
    tuned += std::string(", ") + name + ": {}";
  }
  robot.replace(robot.find("${viscous}"), 10, "${" + sum + "}");
  robot.insert(robot.find("  <codesign:parameter"), declared);
  const std::string study =
      motion_servo() +
      "identify: {data: [{csv: data.csv}], residual: motion, segment: 0.4}\nparameters: {" + tuned +
      "}\n";
  const Problem problem = load_problem({"pendulum.urdf", robot}, {}, {"study.yaml", study});
  const Prepared p(problem, "hinge", 1.0);
  ASSERT_EQ(p.of.columns.size(), 9U);
  SegmentRun whole(p.of, p.segment.begin), part(p.of, p.segment.begin);
  ASSERT_TRUE(whole.run(p.at, p.segment.begin, p.segment.times).ok());
  for (const SegmentLanes lanes :
       {SegmentLanes::kNone, SegmentLanes::kStart, SegmentLanes::kNone, SegmentLanes::kAll}) {
    ASSERT_TRUE(part.run(p.at, p.segment.begin, p.segment.times, lanes).ok());
    EXPECT_EQ(part.values(), whole.values());
    if (lanes == SegmentLanes::kNone) continue;
    EXPECT_EQ(part.slopes().rightCols(p.of.starts), whole.slopes().rightCols(p.of.starts));
  }
  EXPECT_EQ(part.slopes(), whole.slopes());
}

}  // namespace
}  // namespace codesign
