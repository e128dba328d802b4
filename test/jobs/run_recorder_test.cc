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

bool is_told(const Warnings& warnings, const std::string& code) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

TEST(SmoothingWatch, NamesASmoothingAboveAHundredthOfTheLoad) {
  // The pin carries about 10 N, the gear moves a rotor with up to 0.3 N m.
  const std::string pin =
      "<codesign:friction mu_static='0.1' mu_dynamic='0.1' joint_length='0.1' pin_radius='0.01'";
  for (const auto& [smoothing, told] :
       std::vector<std::pair<std::string, bool>>{{"", false},
                                                 {" smoothing='0.001'", false},
                                                 {" smoothing='1'", true},
                                                 {" smoothing='100'", true}}) {
    EXPECT_EQ(is_told(warnings_of_swing(pin + smoothing + "/>"), "large_smoothing"), told)
        << smoothing;
    EXPECT_EQ(is_told(warnings_of_swing("<codesign:actuator rotor_inertia='0.1' efficiency='0.9'" +
                                        smoothing + "/>"),
                      "large_smoothing"),
              told)
        << smoothing;
  }
}

/// A block that falls 0.5 m onto a stop of a range of 1 m.
RunSummary dropped_onto_stop(const std::string& mass, const std::string& limits) {
  const Problem problem = load_problem(
      {"p.urdf",
       "<robot name='p'><link name='ground'/><link name='block'><inertial><mass value='" + mass +
           "'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial>"
           "</link><joint name='lift' type='prismatic'><parent link='ground'/><child "
           "link='block'/><axis xyz='0 0 1'/><limit lower='0' upper='1' effort='0' velocity='0'/>"
           "</joint></robot>"},
      {},
      {"p.yaml", "duration: 1.0\ninitial_state: {lift: {position: 0.5}}\nlimits: {position: true" +
                     limits + "}\n"});
  return record_run(problem, problem.parameters(), {}, 3, [](const std::vector<double>&) {});
}

TEST(StopWatch, NamesStopsThatGiveWayBetweenTheSamples) {
  for (const char* mass : {"0.001", "1", "2000"})
    EXPECT_TRUE(dropped_onto_stop(mass, "").crossings.empty()) << mass;
  const RunSummary soft = dropped_onto_stop("2000", ", stiffness: 1e4");
  ASSERT_EQ(soft.crossings.size(), 1U);
  EXPECT_EQ(soft.crossings[0].limit, "lower");
  EXPECT_LT(soft.crossings[0].worst, -0.1);
  EXPECT_GT(soft.crossings[0].time, std::sqrt(2.0 * 0.5 / 9.81)) << "when it arrives";
  const RunSummary brief = dropped_onto_stop("2", ", stiffness: 2e4, dissipation: 0");
  ASSERT_EQ(brief.crossings.size(), 1U) << "an impact of 30 ms, none of three samples";
  EXPECT_LT(brief.crossings[0].worst, -0.02);
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
