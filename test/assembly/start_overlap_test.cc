// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_overlap.h"

#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "integration/touching.h"

namespace codesign {
namespace {

Warnings of_start(const std::string& height) {
  const RobotDescription robot =
      read_urdf({"test.urdf", free_ball("", touching_ground("shape='plane'", ""))});
  Warnings warnings;
  make_system(robot,
              read_study({"test.yaml", "duration: 1\ninitial_state: {free: {translation: [0, 0, " +
                                           height + "]}}\n"},
                         robot),
              &warnings);
  return warnings;
}

TEST(StartOverlap, IsToldFromATwentiethOfTheSmallerShape) {
  EXPECT_TRUE(of_start("0.2").empty());
  EXPECT_TRUE(of_start("0.0476").empty()) << "2.4 mm of 50 mm";
  const Warnings warnings = of_start("0.046");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "start_overlaps");
  // 2/5 1e6 0.004^2.5 = 0.4048 J
  for (const char* part : {"<codesign:contact name=\"touch\">", "0.004 m", "0.4048 J", "0.0025 m"})
    EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
}

TEST(StartOverlap, IsAnErrorBeyondTheSmallerShape) {
  EXPECT_EQ(of_start("0.001").size(), 1U);
  try {
    of_start("-0.001");
    FAIL() << "on the wrong side";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "test.urdf");
    EXPECT_GT(error.fault().where.line, 0);
    EXPECT_EQ(error.fault().value, "0.051 m");
    EXPECT_NE(error.fault().allowed.find("0.05 m"), std::string::npos) << error.fault().allowed;
  }
}

TEST(Contact, OfTwoLinksOfOneBodyIsAnError) {
  try {
    const RobotDescription of_one = read_urdf(
        {"test.urdf",
         robot(bar("arm") + hinge("hinge", "ground", "arm", "0 0 0") +
               "<link name='tip'/><joint name='weld' type='fixed'><parent link='arm'/><child "
               "link='tip'/></joint><codesign:contact name='c' stiffness='1'><predecessor "
               "link='arm' shape='plane'/><successor link='tip' shape='sphere' radius='1'/>"
               "</codesign:contact>")});
    make_system(of_one, read_study({"test.yaml", "duration: 1\n"}, of_one), nullptr);
    FAIL() << "one body";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("both links belong to one body"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
