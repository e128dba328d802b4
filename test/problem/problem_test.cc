// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/load_problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "equations/compiled_system.h"
#include "mechanism_codesign/error.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

const SourceText kPendulum{"pendulum.urdf",
                           R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="1" lower="0.5" upper="2" unit="m"/>
  <codesign:parameter name="weight" value="3"/>
  <link name="ground"/>
  <link name="arm">
    <inertial>
      <origin xyz="0 0 -1" codesign:xyz="0 0 ${-length}"/>
      <mass value="3" codesign:value="${weight}"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial>
  </link>
  <joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="1 0 0"/></joint>
</robot>)"};

const SourceText kStudy{"swing.yaml", R"(
duration: 1.0
controllers: {hold: {type: pid, input: hinge/position, setpoint: 0, output: hinge, gains: {p: "${Kp}"}}}
parameters: {Kp: {initial: 2.0, lower: 0.0, upper: 9.0}, length: {}}
objective: {integral: [{signal: hinge/position}]}
)"};

TEST(Problem, HoldsAllParametersAndTheStart) {
  const Problem problem = load_problem(kPendulum, {}, kStudy);
  EXPECT_EQ(robot_of(problem).name, "pendulum");
  EXPECT_EQ(problem.parameters(), (std::vector<double>{1.0, 3.0, 2.0}));
  EXPECT_EQ(problem.start(), Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(problem.tuned_names(), (std::vector<std::string>{"Kp", "length"}));
  EXPECT_EQ(problem.parameters(Eigen::Vector2d(5.0, 0.7)), (std::vector<double>{0.7, 3.0, 5.0}));
  EXPECT_NE(system_of(problem), nullptr);
}

TEST(Problem, SettingsReplaceStartsAndDefaults) {
  const Problem problem =
      load_problem(kPendulum, {}, kStudy, {{"Kp", 4.0}, {"weight", 5.0}, {"Kp", 6.0}});
  EXPECT_EQ(problem.parameters(), (std::vector<double>{1.0, 5.0, 6.0}));
  EXPECT_EQ(problem.start(), Eigen::Vector2d(6.0, 1.0));
}

TEST(Problem, ValuesOfADesignByName) {
  const Problem problem = load_problem(kPendulum, {}, kStudy);
  const ParameterSettings settings{{"Kp", 4.0}, {"weight", 5.0}, {"Kp", 6.0}};
  EXPECT_EQ(problem.parameters(settings), (std::vector<double>{1.0, 5.0, 6.0}));
  EXPECT_EQ(problem.parameters(ParameterSettings{}), problem.parameters());
  EXPECT_THROW(problem.parameters({{"Kp", 9.5}}), InputError);
  EXPECT_THROW(problem.parameters({{"lenght", 1.0}}), InputError);
}

TEST(Problem, AMechanismAloneTunesNothing) {
  const Problem problem = load_mechanism(kPendulum, {}, {{"length", 1.5}});
  EXPECT_EQ(problem.parameters(), (std::vector<double>{1.5, 3.0}));
  EXPECT_EQ(problem.start().size(), 0);
  EXPECT_TRUE(problem.tuned_names().empty());
}

TEST(Problem, OverlaysAreMerged) {
  const SourceText overlay{"overlay.urdf",
                           R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
    <joint name="hinge"><codesign:friction model="brown_mcphee" mu_static="0.4" mu_dynamic="0.3" joint_length="0.02" pin_radius="0.01"/></joint></robot>)"};
  EXPECT_TRUE(robot_of(load_mechanism(kPendulum, {overlay})).joints.at(0).friction.has_value());
}

void expect_refused(const ParameterSettings& settings, const std::string& message,
                    const std::string& allowed) {
  try {
    load_problem(kPendulum, {}, kStudy, settings);
    ADD_FAILURE() << message;
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, settings.back().first);
    EXPECT_NE(error.fault().message.find(message), std::string::npos) << error.what();
    EXPECT_EQ(error.fault().allowed, allowed);
  }
}

TEST(Problem, SettingsMustNameAParameterAndKeepItsBounds) {
  expect_refused({{"lenght", 1.0}}, "did you mean \"length\"", "length, weight, Kp");
  expect_refused({{"Kp", 9.5}}, "outside", "[0, 9]");
  expect_refused({{"length", 0.4}}, "outside", "[0.5, 2]");
  expect_refused({{"weight", std::numeric_limits<double>::quiet_NaN()}}, "outside", "[-inf, inf]");
}

/// A base of 2 kg, alone or with an arm.
SourceText based(const std::string& more = "", const std::string& root = "base") {
  return {"robot.urdf",
          "<robot name=\"robot\"><link name=\"" + root +
              R"("><inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0"
  izz="0.2"/></inertial></link>)" +
              more + "</robot>"};
}

const std::string kArmOnBase =
    R"(<link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="1"/><inertia ixx="0.1" ixy="0"
  ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link><joint name="hinge" type="continuous">
  <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>)";

bool warns(const Problem& problem, const std::string& code) {
  return std::any_of(problem.warnings().begin(), problem.warnings().end(),
                     [&code](const Warning& warning) { return warning.code == code; });
}

TEST(FloatingBaseOfAStudy, LetsOneBodyFly) {
  const Problem problem = load_problem(
      based(), {},
      {"fall.yaml",
       "duration: 0.5\nbase: floating\ninitial_state: {floating_base: {translation: [0, 0, 5], "
       "rotation: [0.1, 0.2, 0.3], linear_velocity: [1, 0, 2], angular_velocity: [0, 0, 3]}}\n"});
  EXPECT_TRUE(problem.warnings().empty());
  Simulation simulation(problem, problem.parameters(), {"base/position/x", "base/position/z"});
  std::vector<double> last;
  ASSERT_TRUE(simulate(&simulation, 0.5, 2, [&last](const Frame& frame) {
                last = frame.signals;
                return true;
              }).ok());
  ASSERT_EQ(last.size(), 2U);
  EXPECT_NEAR(last[0], 0.5, 1e-7);
  EXPECT_NEAR(last[1], 5.0 + 1.0 - 0.5 * 9.81 * 0.25, 1e-7);
}

TEST(FloatingBaseOfAStudy, IsNamedWhereNothingMoves) {
  try {
    load_problem(based(), {}, {"fall.yaml", "duration: 0.5\n"});
    ADD_FAILURE() << "nothing moves";
  } catch (const InputError& error) {
    for (const char* part : {"nothing moves", "base: floating", "--base floating"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_THROW(load_problem(based(), {}, {"fall.yaml", "duration: 0.5\nbase: swimming\n"}),
               InputError);
}

TEST(FloatingBaseOfAStudy, ABaseWithMassThatStandsIsToldUntilTheStudySaysSo) {
  const auto with = [](const std::string& study, const std::string& more) {
    return load_problem(based(more), {}, {"swing.yaml", "duration: 0.5\n" + study});
  };
  const Problem silent = with("", kArmOnBase);
  ASSERT_EQ(silent.warnings().size(), 1U);
  EXPECT_EQ(silent.warnings()[0].code, "fixed_base");
  for (const char* part : {"2 kg", "base: floating", "--base floating", "base: fixed"})
    EXPECT_NE(silent.warnings()[0].message.find(part), std::string::npos)
        << silent.warnings()[0].message;
  EXPECT_FALSE(warns(with("base: fixed\n", kArmOnBase), "fixed_base"));
  EXPECT_FALSE(warns(with("base: floating\n", kArmOnBase), "fixed_base"));
  // Fixed to a link that is named after the ground it stands.
  const std::string stand =
      R"(<link name="world"/><joint name="stand" type="fixed"><parent link="world"/><child
         link="base"/></joint>)";
  EXPECT_FALSE(warns(with("", kArmOnBase + stand), "fixed_base"));
  const std::string base_link =
      R"(<link name="root"/><joint name="stand" type="fixed"><parent link="root"/><child
         link="base"/></joint>)";
  EXPECT_TRUE(warns(with("", kArmOnBase + base_link), "fixed_base"));
}

TEST(FloatingBaseOfAStudy, TravelsWithTheProblemToOtherProcesses) {
  const Problem problem =
      load_problem(based(kArmOnBase), {}, {"swing.yaml", "duration: 0.5\nbase: floating\n"});
  const Problem there = load_portable(make_portable(problem));
  EXPECT_EQ(robot_of(there).joints.size(), 2U);
  EXPECT_EQ(system_of(there)->layout().n, system_of(problem)->layout().n);
}

}  // namespace
}  // namespace codesign
