// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "jobs/json.h"
#include "jobs/run_recorder.h"
#include "jobs/tuned_pendulum.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

const Json& signal_of(const Json& summary, const char* name) {
  for (const Json& signal : summary["signals"])
    if (signal["name"] == name) return signal;
  throw std::out_of_range(name);
}

TEST(DesignRecord, EnergiesBalance) {
  const Problem problem = pendulum_on_hardware();
  const DesignRecord record = record_design(problem, problem.parameters());
  ASSERT_TRUE(record.status.ok());
  const Json& energy = record.summary["energy"];
  EXPECT_LT(energy["friction"].get<double>(), 0.0);
  EXPECT_EQ(record.summary["friction_energy"]["hinge"], energy["friction"])
      << "the one joint with friction";
  // The energy that the powers put in equals the gain of kinetic and potential energy, here from
  // the first and the last row of a run with these signals.
  Simulation simulation(problem, problem.parameters(), {"mechanism/total_energy"});
  std::vector<double> total;
  const auto keep = [&total](const Frame& frame) {
    total.push_back(frame.signals[0]);
    return true;
  };
  ASSERT_TRUE(simulate(&simulation, problem.duration(), 2, keep).ok());
  const double in = energy["friction"].get<double>() + energy["damping"].get<double>() +
                    energy["actuator"].get<double>();
  EXPECT_NEAR(total[1] - total[0], in, 1e-5 * std::abs(in));
}

TEST(DesignRecord, PeaksLieInTheTable) {
  const Problem problem = pendulum_on_hardware();
  const DesignRecord record = record_design(problem, problem.parameters());
  const Json& velocity = signal_of(record.summary, "hinge/velocity");
  EXPECT_LT(velocity["smallest"].get<double>(), -1.0);
  EXPECT_EQ(velocity["largest_time"], 0.0) << "it starts at rest and falls";
  EXPECT_EQ(velocity["upper"], 2.0);
  EXPECT_EQ(std::count(record.csv.begin(), record.csv.end(), '\n'), 502)
      << "a header and 501 instants";
  EXPECT_EQ(record.csv.rfind("time,hinge/position", 0), 0U);
  EXPECT_NE(record.csv.find("hold/error"), std::string::npos);
  const Json& poses = record.summary["poses"];
  EXPECT_EQ(poses["times"].size(), 5U);
  EXPECT_EQ(poses["links"]["bob"][0].size(), 7U);
}

/// The warnings of a pendulum that swings at up to about 1 rad/s, with a number of its hinge.
Warnings warnings_of_swing(const std::string& annotation) {
  const std::string urdf =
      "<robot name='p' xmlns:codesign='urn:t'><link name='ground'/><link "
      "name='bar'><inertial><origin xyz='0 0 -0.5'/><mass value='1'/><inertia ixx='0.08' ixy='0' "
      "ixz='0' iyy='0.08' iyz='0' izz='0.01'/></inertial></link><joint name='hinge' "
      "type='continuous'><parent link='ground'/><child link='bar'/><axis xyz='0 1 0'/>" +
      annotation + "</joint></robot>";
  const Problem problem = load_problem(
      {"p.urdf", urdf}, {}, {"p.yaml", "duration: 1.0\ninitial_state: {hinge: {position: 0.3}}\n"});
  const RunSummary run =
      record_run(problem, problem.parameters(), {}, 101, [](const std::vector<double>&) {});
  EXPECT_TRUE(run.status.ok()) << run.status.cause;
  return run.warnings;
}

TEST(TransitionWatch, NamesATransitionThatTheMotionNeverReaches) {
  const Warnings of_friction =
      warnings_of_swing("<codesign:friction coulomb='0.01' transition_velocity='4'/>");
  ASSERT_EQ(of_friction.size(), 1U);
  EXPECT_EQ(of_friction[0].code, "transition_beyond_motion");
  EXPECT_NE(of_friction[0].message.find("<codesign:friction>"), std::string::npos);
  EXPECT_EQ(warnings_of_swing("<codesign:actuator rotor_inertia='0' efficiency='0.9' "
                              "transition_velocity='4'/>")
                .size(),
            1U);
  EXPECT_TRUE(warnings_of_swing("<codesign:friction coulomb='0.01'/>").empty());
  EXPECT_TRUE(warnings_of_swing("<codesign:friction coulomb='0.01' static='0.02' "
                                "model='lugre' transition_velocity='4'/>")
                  .empty())
      << "bristles stick";
}

TEST(DesignRecord, ACancelledRunSaysSo) {
  const std::atomic<bool> cancel{true};
  const DesignRecord record = record_design(pendulum(), pendulum().parameters(), &cancel);
  EXPECT_EQ(record.status.code, StatusCode::kCancelled);
  EXPECT_EQ(record.summary["status"]["code"], "cancelled");
  EXPECT_FALSE(record.summary.contains("energy"));
}

}  // namespace

}  // namespace codesign
