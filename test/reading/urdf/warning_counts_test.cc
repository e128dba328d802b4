// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "reading/urdf/urdf_checks.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

Warning warning_at(const std::string& code, const std::string& file, int line) {
  return {code, "of line " + std::to_string(line), {file, line}};
}

TEST(WarningCounts, KeepTheFirstOfEachCodeAndFile) {
  Warnings warnings{warning_at("limit_ignored", "a.urdf", 3),
                    warning_at("triangle_inequality", "a.urdf", 4),
                    warning_at("limit_ignored", "a.urdf", 5),
                    warning_at("second_parent", "a.urdf", 6),
                    warning_at("second_parent", "a.urdf", 7),
                    warning_at("limit_ignored", "a.urdf", 9),
                    warning_at("triangle_inequality", "a.urdf", 11),
                    warning_at("limit_ignored", "b.urdf", 1)};
  count_repetitions(&warnings);
  ASSERT_EQ(warnings.size(), 5U);
  EXPECT_EQ(warnings[0].message,
            "of line 3; the same at 2 further places of this file, the last in line 9");
  EXPECT_EQ(warnings[1].message,
            "of line 4; the same at 1 further place of this file, the last in line 11");
  EXPECT_EQ(warnings[2].message, "of line 6") << "each says what becomes of a joint";
  EXPECT_EQ(warnings[3].message, "of line 7");
  EXPECT_EQ(warnings[4].message, "of line 1") << "another file";
}

TEST(WarningCounts, OfAVendorsFile) {
  std::string links = "<link name=\"l0\"/>", joints;
  for (int k = 1; k <= 12; ++k) {
    const std::string name = "l" + std::to_string(k), parent = "l" + std::to_string(k - 1);
    links += "<link name=\"" + name +
             "\"><inertial><mass value=\"1\"/><inertia ixx=\"9\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
             "iyz=\"0\" izz=\"1\"/></inertial></link>\n";
    joints += "<joint name=\"j" + std::to_string(k) + "\" type=\"continuous\"><parent link=\"" +
              parent + "\"/><child link=\"" + name +
              "\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" "
              "velocity=\"1\"/></joint>\n";
  }
  const RobotDescription robot =
      read_urdf({"vendor.urdf", "<robot name=\"vendor\">" + links + joints + "</robot>"});
  ASSERT_EQ(robot.warnings.size(), 2U);
  EXPECT_EQ(robot.warnings[0].code, "triangle_inequality");
  EXPECT_EQ(robot.warnings[1].code, "limit_ignored");
  for (const Warning& warning : robot.warnings)
    EXPECT_NE(warning.message.find("the same at 11 further places"), std::string::npos)
        << warning.message;
}

}  // namespace
}  // namespace codesign
