// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(VocabularyCheck, AllOfAFileAreToldInTheOrderOfItsLines) {
  const RobotDescription robot =
      read_urdf(hinged_arm("<dynamics damping=\"1\" K=\"2\"/>",
                           "<link name=\"tip\" colour=\"red\"/>\n" +
                               joint_with("j", "fixed", "arm", "tip", "<mimic joint=\"hinge\"/>")));
  ASSERT_EQ(robot.warnings.size(), 3U);
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(robot.warnings[static_cast<std::size_t>(k)].where.line, k + 2);
}

TEST(VocabularyCheck, TheSameNameInTheSameKindOfElementIsToldOnceWithACount) {
  const std::string inertia =
      "<inertial><origin xyz=\"0 0 0\"/><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
      "iyx=\"0.5\" iyy=\"1\" iyz=\"0\" "
      "izz=\"1\"/></inertial>\n";
  std::string links;
  for (const char* name : {"a", "b", "c"})
    links += "<link name=\"" + std::string(name) + "\">" + inertia + "</link>\n" +
             joint_with("j" + std::string(name), "fixed", "arm", name, "") + "\n";
  const RobotDescription robot = read_urdf(hinged_arm(
      "", links + "<link name=\"d\" iyx=\"2\"/>" + joint_with("jd", "fixed", "arm", "d", "")));
  std::vector<std::string> messages;
  for (const Warning& warning : robot.warnings)
    if (warning.code == "unknown_attribute") messages.push_back(warning.message);
  ASSERT_EQ(messages.size(), 2U) << "one of <inertia>, one of <link>";
  EXPECT_NE(messages[0].find("; the same at 2 further places of this file, the last in line"),
            std::string::npos)
      << messages[0];
  EXPECT_EQ(messages[1].find("further"), std::string::npos) << messages[1];
}

TEST(VocabularyCheck, RepeatedElements) {
  expect_warning(hinged_arm("<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>"), "repeated_element",
                 {"a second <axis>; the first one is used"});
  EXPECT_EQ(read_urdf(hinged_arm("<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>"))
                .joints[0]
                .axis[2]
                .nominal(),
            1.0);
  const std::string friction =
      "<codesign:friction mu_static=\"1\" mu_dynamic=\"1\" joint_length=\"1\" pin_radius=\"1\"/>";
  expect_error(hinged_arm(friction + friction), {"a second <codesign:friction>"});
  expect_error(hinged_arm("",
                          "<loop name=\"l\" type=\"revolute\"><predecessor "
                          "link=\"arm\"/><predecessor link=\"arm\"/>"
                          "<successor link=\"ground\"/></loop>"),
               {"a second <predecessor>"});
}

}  // namespace
}  // namespace codesign
