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

TEST(DesignRecord, ACancelledRunSaysSo) {
  const std::atomic<bool> cancel{true};
  const DesignRecord record = record_design(pendulum(), pendulum().parameters(), &cancel);
  EXPECT_EQ(record.status.code, StatusCode::kCancelled);
  EXPECT_EQ(record.summary["status"]["code"], "cancelled");
  EXPECT_FALSE(record.summary.contains("energy"));
}

}  // namespace

}  // namespace codesign
