// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Runs that start or end exactly on a guard, or only touch it at their end.
#include "sensitivity/one_sided.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "assembly/make_system.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// 1 kg that slides along x for 2 s. @param solver keys of the block.
Evaluation slid(const std::string& study, const std::string& solver = "") {
  const RobotDescription robot = read_urdf({"slide.urdf", R"(<robot name="slider">
  <link name="ground"/>
  <link name="body"><inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="body"/>
    <axis xyz="1 0 0"/><limit lower="-1000" upper="1000" effort="50" velocity="1000"/></joint>
</robot>)"});
  const auto system = make_system(
      robot,
      read_study({"study.yaml", "duration: 2.0\nsolver: {" + solver + "}\n" + study}, robot));
  return evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
}

std::string said(const Evaluation& run, const char* code) {
  for (const Warning& warning : run.warnings)
    if (warning.code == code) return warning.message;
  return "";
}

void expect_parts(const std::string& text, const std::vector<const char*>& parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

// v(2) = 2 for all ts from 2 on, and 2 ts - 2 before: (v(2))^2 has the derivatives 0 and 8.
TEST(OneSidedGradient, IsSaidWhereARunEndsOnAGuard) {
  for (const char* const solver : {"gradient: direct", "gradient: adjoint"}) {
    const Evaluation run = slid(R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 2, lower: 0.1, upper: 3}}
objective: {terminal: [{signal: slide/velocity}]})",
                                solver);
    ASSERT_TRUE(run.status.ok()) << describe(run.status);
    EXPECT_NEAR(run.gradient[0], 0.0, 1e-7);
    expect_parts(said(run, "one_sided_gradient"),
                 {"loads[0].effort, \"t < ts\"", "\"ts\" is 0 for", "8 for runs that pass it"});
  }
}

TEST(OneSidedGradient, IsSaidWhereAFinalSignalMovesWithTheGuard) {
  const Evaluation run = slid(R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 2, lower: 0.1, upper: 3}}
final: [{signal: slide/velocity, at_most: 9}]
objective: {terminal: [{signal: slide/position}]})");
  ASSERT_TRUE(run.status.ok()) << describe(run.status);
  expect_parts(said(run, "one_sided_gradient"), {"loads[0].effort, \"t < ts\""});
}

TEST(OneSidedGradient, IsSaidOfTheSideToWhichAMotionStarts) {
  const char* const study = R"(
initial_state: {slide: {position: "${x0}", velocity: 1.0}}
loads: [{joint: slide, effort: "${slide/position > 0.3 ? -0.5 : 0}"}]
parameters: {x0: {initial: 0.3, lower: -1, upper: 1}}
objective: {terminal: [{signal: slide/position}]})";
  const Evaluation run = slid(study), adjoint = slid(study, "gradient: adjoint");
  ASSERT_TRUE(run.status.ok()) << describe(run.status);
  EXPECT_EQ(said(adjoint, "one_sided_gradient"), said(run, "one_sided_gradient"));
  // x(2) = x0 + 2 - 1 behind the threshold; from before it the derivative is 1 - 0.5 * 2 = 0.
  EXPECT_NEAR(run.gradient[0], 2.0 * 1.3, 1e-6);
  expect_parts(said(run, "one_sided_gradient"),
               {"loads[0].effort, \"slide/position > 0.3\"", "starts exactly", "\"x0\""});
}

// No parameter moves the start or the threshold; and a switch before the end.
TEST(OneSidedGradient, IsNotSaidWhereBothSidesAgree) {
  EXPECT_EQ(said(slid(R"(
initial_state: {slide: {position: 0.3, velocity: 1.0}}
loads: [{joint: slide, effort: "${slide/position > 0.3 ? f : 0}"}]
parameters: {f: {initial: -0.5, lower: -1, upper: 1}}
objective: {terminal: [{signal: slide/position}]})"),
                 "one_sided_gradient"),
            "");
  EXPECT_EQ(said(slid(R"(
loads: [{joint: slide, effort: "${t < ts ? 1 : -1}"}]
parameters: {ts: {initial: 1.99, lower: 0.1, upper: 3}}
objective: {terminal: [{signal: slide/velocity}]})"),
                 "one_sided_gradient"),
            "");
  // A kink: the motion and its rates are continuous.
  EXPECT_EQ(said(slid(R"(
loads: [{joint: slide, effort: "${max(0, t - ts)}"}]
parameters: {ts: {initial: 2, lower: 0.1, upper: 3}}
objective: {terminal: [{signal: slide/velocity, reference: 1}]})"),
                 "one_sided_gradient"),
            "");
}

// The guard (t - ts)^3 has no rate where it is zero.
TEST(OneSidedGradient, DoesNotExistWhereTheEndOnlyTouchesItsGuard) {
  const Evaluation run = slid(R"(
until: "${(t - ts)^3 >= 0}"
initial_state: {slide: {velocity: 1.0}}
parameters: {ts: {initial: 1, lower: 0.1, upper: 1.9}}
objective: {terminal: [{signal: slide/position}]})");
  EXPECT_EQ(run.status.code, StatusCode::kNonFiniteGradient);
  expect_parts(run.status.cause, {"only touches the guard of until, \"(t - ts)^3 >= 0\""});
  expect_parts(said(run, "grazing_event"), {"until"});
}

}  // namespace
}  // namespace codesign
