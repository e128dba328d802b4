// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "description/robot.h"
#include "description/study.h"
#include "reading/study/study_reader.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

Study read_traded(const std::string& tradeoff) {
  const RobotDescription robot = read_urdf({"cart.urdf", R"(<robot name="cart"><link name="ground"/>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/>
  <limit lower="-5" upper="5" effort="100" velocity="10"/></joint></robot>)"},
                                           {});
  return read_study({"cart.yaml", "duration: 1.0\nparameters: {k: {initial: 1.0}}\n" + tradeoff},
                    robot);
}

std::string place_of_fault(const std::string& tradeoff) {
  try {
    read_traded(tradeoff);
  } catch (const InputError& error) {
    return error.fault().element;
  }
  return "";
}

const std::string kFirstItem =
                      "{name: one, objective: {terminal: [{signal: slide/position, reference: "
                      "\"${k}\"}]}}",
                  kSecondItem =
                      "{name: two, objective: {integral: [{signal: slide/velocity}], peak: "
                      "[{signal: slide/position}]}}";

TEST(StudyTradeoff, IsAStudyForEachObjective) {
  const Study study = read_traded("tradeoff: [" + kFirstItem + ", " + kSecondItem +
                                  "]\npath: [{signal: slide/position, "
                                  "at_most: 2.0}]\n");
  ASSERT_EQ(study.tradeoff.size(), 2u);
  EXPECT_TRUE(study.integral.empty() && study.terminal.empty());
  EXPECT_EQ(study.tradeoff[0].name, "one");
  EXPECT_EQ(study.tradeoff[0].study->terminal.size(), 1u);
  EXPECT_EQ(study.tradeoff[0].study->watched.size(), 1u);
  EXPECT_EQ(study.tradeoff[1].study->integral.size(), 1u);
  ASSERT_EQ(study.tradeoff[1].study->watched.size(), 2u);
  EXPECT_EQ(study.tradeoff[1].study->watched[1].element, "tradeoff[1].objective.peak[0]");
  EXPECT_EQ(study.used_parameters.size(), 1u) << "by the first objective";
}

TEST(StudyTradeoff, FaultsHaveTheirPlaces) {
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem + "]\n"), "tradeoff");
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem + ", " + kFirstItem + "]\n"),
            "tradeoff[1].name");
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem + ", {name: two, objective: {}}]\n"),
            "tradeoff[1].objective");
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem + ", {name: a b, objective: {}}]\n"),
            "tradeoff[1].name");
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem +
                           ", {name: two, objective: {terminal: [{signal: "
                           "slide/nothing}]}}]\n"),
            "tradeoff[1].objective.terminal[0].signal");
  EXPECT_EQ(place_of_fault("tradeoff: [" + kFirstItem + ", " + kSecondItem +
                           "]\nobjective: {terminal: [{signal: slide/position}]}\n"),
            "objective");
}

}  // namespace
}  // namespace codesign
