// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "identification/identify.h"
#include "identification/simulated_recording.h"
#include "integration/mechanisms.h"

namespace codesign {
namespace {

TEST(ArmatureFit, FindsThatOfALinkThatMoves) {
  const std::string urdf =
      robot("<codesign:parameter name='armature' value='0.1' lower='0' upper='5'/>" + bar("upper") +
            bar("lower") + hinge("shoulder", "ground", "upper", "0 0 0") +
            hinge("elbow", "upper", "lower", "0 0 -1",
                  "<codesign:actuator armature='0.1' codesign:armature='${armature}'/>"));
  const Problem bench = load_problem(
      {"arm.urdf", urdf}, {},
      {"bench.yaml",
       "duration: 4\ncontrollers: {one: {type: state_feedback, output: shoulder, feedforward: "
       "\"${6*sin(3*t)}\"}, two: {type: state_feedback, output: elbow, feedforward: "
       "\"${4*sin(7*t)}\"}}\nparameters: {armature: {}}\nsolver: {relative_tolerance: 1.0e-10, "
       "absolute_tolerance: 1.0e-11}\n"});
  StudyRecordings recordings;
  recordings.data = {record_run(bench, {{"armature", 0.4}}, {"shoulder", "elbow"}, 500.0)};
  for (const char* residual : {"effort", "motion"}) {
    const Problem problem = load_problem(
        {"arm.urdf", urdf}, {},
        {"study.yaml", "identify: {residual: " + std::string(residual) +
                           (std::string(residual) == "motion" ? ", segment: 1.0" : "") +
                           "}\nparameters: {armature: {}}\n"});
    const IdentificationResult result = identify(problem, recordings, {}, nullptr);
    ASSERT_TRUE(result.status.ok()) << residual << result.status.cause;
    EXPECT_NEAR(result.numbers[0].value, 0.4, 1e-3) << residual;
  }
}

}  // namespace
}  // namespace codesign
