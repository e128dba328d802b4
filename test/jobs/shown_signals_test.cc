// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>

#include "description/study.h"
#include "jobs/json.h"
#include "jobs/shown_signals.h"
#include "jobs/tuned_pendulum.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const ShownSignal* find_shown(const std::vector<ShownSignal>& shown, const std::string& name) {
  const auto found = std::find_if(shown.begin(), shown.end(), [&](const ShownSignal& signal) {
    return signal.signal.text == name;
  });
  return found == shown.end() ? nullptr : &*found;
}

TEST(ShownSignals, HaveUnitsAndLimits) {
  const Problem problem = pendulum_on_hardware();
  const std::vector<ShownSignal> shown = shown_signals(problem, problem.parameters());
  const std::pair<const char*, const char*> units[] = {{"hinge/position", "rad"},
                                                       {"hinge/velocity", "rad/s"},
                                                       {"hinge/effort", "N m"},
                                                       {"hinge/friction", "N m"},
                                                       {"hinge/normal_force", "N"},
                                                       {"hold/error", "rad"},
                                                       {"hold/setpoint", "rad"},
                                                       {"hold/output", "N m"},
                                                       {"hinge/friction_power", "W"},
                                                       {"mechanism/load_power", "W"},
                                                       {"hinge/sliding_velocity", "rad/s"}};
  for (const auto& [name, unit] : units) {
    const ShownSignal* signal = find_shown(shown, name);
    ASSERT_NE(signal, nullptr) << name;
    EXPECT_EQ(signal->unit, unit) << name;
  }
  EXPECT_EQ(find_shown(shown, "hinge/effort")->lower, -3.0);
  EXPECT_EQ(find_shown(shown, "hinge/effort")->upper, 3.0);
  EXPECT_EQ(find_shown(shown, "hinge/velocity")->upper, 2.0);
  EXPECT_FALSE(find_shown(shown, "hinge/position")->upper) << "a continuous joint has no stops";
  for (std::size_t i = 0; i < shown.size(); ++i)
    EXPECT_EQ(find_shown(shown, shown[i].signal.text), &shown[i])
        << "twice: " << shown[i].signal.text;
}

TEST(ShownSignals, UnitsOfLinksAndDifferences) {
  const Problem problem = pendulum();
  const auto unit = [&problem](const char* text) {
    return unit_of(parse_signal(text, {}, ""), robot_of(problem), study_of(problem).controllers);
  };
  EXPECT_EQ(unit("bob/position/x - ground/position/x"), "m");
  EXPECT_EQ(unit("bob/velocity/z"), "m/s");
  EXPECT_EQ(unit("bob/angular_velocity/z"), "rad/s");
  EXPECT_EQ(unit("bob/orientation/w"), "");
  EXPECT_EQ(unit("hinge/acceleration"), "rad/s²");
  EXPECT_EQ(unit("hinge/reaction_torque/y"), "N m");
  EXPECT_EQ(unit("mechanism/total_energy"), "J");
  EXPECT_EQ(unit("hold/integral"), "rad s");
}

TEST(ShownSignals, FrictionOfACylindricalJointIsThatOfItsTurn) {
  const Problem problem = load_problem(
      {"sleeve.urdf",
       "<robot name='sleeve' xmlns:codesign='urn:mechanism_codesign'><link name='ground'/><link "
       "name='sleeve'><inertial><mass value='1'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' "
       "iyz='0' izz='0.1'/></inertial></link><joint name='shaft' type='floating' "
       "codesign:type='cylindrical'><parent link='ground'/><child link='sleeve'/><axis xyz='0 0 "
       "1'/><codesign:friction mu_static='0.2' mu_dynamic='0.1' transition_velocity='0.01' "
       "pin_radius='0.01' joint_length='0.05'/></joint></robot>"},
      {}, {"sleeve.yaml", "duration: 1.0\n"}, {}, TrajectoryLoader(), FileLoader());
  const auto unit = [&problem](const char* text) {
    return unit_of(parse_signal(text, {}, ""), robot_of(problem), study_of(problem).controllers);
  };
  EXPECT_EQ(unit("shaft/friction"), "N m");
  EXPECT_EQ(unit("shaft/sliding_velocity"), "rad/s");
}

TEST(WatchedRecords, NameSignalsWithTheirRanges) {
  OptimizationResult result;
  Json object;
  add_watched(result, &object);
  EXPECT_TRUE(object.is_null());
  WatchedResult& watched = result.constraints.watched.emplace_back();
  watched.element = "path[0]";
  watched.signal = "hinge/effort";
  watched.largest = 2.5;
  watched.violation = 0.5;
  add_watched(result, &object);
  EXPECT_EQ(object["signals"][0]["signal"], "hinge/effort");
  EXPECT_EQ(object["signals"][0]["largest"], 2.5);
  EXPECT_EQ(object["signals"][0]["violation"], 0.5);
  EXPECT_TRUE(object["signals"][0]["lower"].is_null());
  EXPECT_FALSE(object["signals"][0].contains("largest_in")) << "one run alone";
}

TEST(WatchedRecords, TellBoundsAndTheRunOfEachExtreme) {
  OptimizationResult result;
  WatchedResult& watched = result.constraints.watched.emplace_back();
  watched.lower = -2.0;
  watched.after = 0.1;
  watched.before = 0.8;
  watched.largest_scenario = 1;
  result.ensemble.scenarios.resize(2);
  result.ensemble.scenarios[0].sample = -1;
  result.ensemble.scenarios[1].run = "loaded";
  result.ensemble.scenarios[1].sample = 3;
  Json object;
  add_watched(result, &object);
  const Json& signal = object["signals"][0];
  EXPECT_EQ(signal["lower"], -2.0);
  EXPECT_TRUE(signal["upper"].is_null());
  EXPECT_EQ(signal["after"], 0.1);
  EXPECT_EQ(signal["before"], 0.8);
  EXPECT_EQ(signal["largest_in"], (Json{{"run", "loaded"}, {"sample", 4}}));
  EXPECT_EQ(signal["smallest_in"], (Json{{"run", ""}, {"sample", 0}}));
}

}  // namespace

}  // namespace codesign
