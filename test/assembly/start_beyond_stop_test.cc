// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_beyond_stop.h"

#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "equations/compiled.h"

namespace codesign {
namespace {

std::string limited(const std::string& type) {
  return robot(bar("arm") + "<joint name='j' type='" + type +
               "'><parent link='ground'/><child link='arm'/><axis xyz='0 1 0'/><limit "
               "lower='-0.5' upper='0.5' effort='10' velocity='1'/></joint>");
}

Warnings of_start(const std::string& type, const std::string& start, const std::string& more) {
  const RobotDescription robot = read_urdf({"test.urdf", limited(type)});
  Warnings warnings;
  make_system(
      robot,
      read_study({"test.yaml", "duration: 1\n" + more + "\ninitial_state: {j: {" + start + "}}\n"},
                 robot),
      &warnings);
  return warnings;
}

TEST(StartBeyondStop, IsToldWithTheEnergyThatTheStopHolds) {
  const std::string stops = "limits: {position: true, stiffness: 1.0e4}";
  for (const char* type : {"revolute", "prismatic"})
    for (const char* at : {"1.0", "-1.0"}) {
      const Warnings warnings = of_start(type, std::string("position: ") + at, stops);
      ASSERT_EQ(warnings.size(), 1U) << type << at;
      EXPECT_EQ(warnings[0].code, "start_beyond_stop");
      EXPECT_EQ(warnings[0].where.line, 3);
      for (const char* part : {"0.5 ", "12", "J", "initial_state.j"})
        EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
    }
  EXPECT_TRUE(of_start("revolute", "position: 0.5", stops).empty()) << "at the stop";
  EXPECT_TRUE(of_start("revolute", "position: 0.505", stops).empty()) << "it rests on the stop";
  EXPECT_TRUE(of_start("revolute", "velocity: 9", stops).empty());
  EXPECT_TRUE(of_start("revolute", "position: 1.0", "limits: {effort: true}").empty())
      << "no stops";
}

}  // namespace
}  // namespace codesign
