// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/foreign_contacts.h"

#include <gtest/gtest.h>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

Warnings found(const std::string& content) {
  return find_foreign_contacts(robot_text(content), {}, read_urdf(robot_text(content)));
}

std::string arm(const std::string& inside) {
  return "<link name='ground'/><link name='arm'>" + std::string(kInertial) + inside +
         "</link><joint name='free' type='floating'><parent link='ground'/><child "
         "link='arm'/></joint>";
}

void expect_says(const std::string& content, const std::vector<std::string>& parts) {
  const Warnings warnings = found(content);
  ASSERT_EQ(warnings.size(), 1U) << content;
  EXPECT_EQ(warnings[0].code, "contact_not_read");
  for (const std::string& part : parts)
    EXPECT_NE(warnings[0].message.find(part), std::string::npos)
        << part << " in " << warnings[0].message;
}

TEST(ForeignContacts, CollisionAloneSaysNothing) {
  EXPECT_TRUE(
      found(arm("<collision><geometry><sphere radius='1'/></geometry></collision>")).empty());
}

TEST(ForeignContacts, OfEachToolShowTheContactToWrite) {
  expect_says(arm("") +
                  "<gazebo reference='arm'><kp>1e6</kp><kd>1</kd><mu1>0.8</mu1><mu2>0.7"
                  "</mu2></gazebo>",
              {"kd, kp, mu1, mu2", "<codesign:contact name=\"...\" stiffness=\"1e+06\"",
               "link=\"arm\"", "mu_static=\"0.8\" mu_dynamic=\"...\""});
  expect_says(arm("<collision><geometry><sphere radius='1'/></geometry><surface><contact><ode><kp>"
                  "2000</kp></ode></contact><bounce><restitution_coefficient>0.5"
                  "</restitution_coefficient></bounce></surface></collision>"),
              {"stiffness=\"2000\" restitution=\"0.5\" impact_velocity=\"...\""});
  expect_says(arm("<contact><stiffness value='500'/><lateral_friction value='0.4'/></contact>"),
              {"stiffness=\"500\"", "mu_static=\"0.4\""});
  expect_says(arm("") +
                  "<mujoco><default><geom solref='0.01 1' friction='0.9 0.1 0.1'/></default>"
                  "</mujoco>",
              {"friction, solref", "mu_static=\"0.9\""});
}

TEST(ForeignContacts, OfSeveralLinksAreCounted) {
  expect_says(arm("<contact><stiffness value='500'/></contact>") +
                  "<gazebo reference='ground'><mu1>0.8</mu1></gazebo>",
              {"stiffness=\"500\"", "2 places have such keys"});
}

TEST(ForeignContacts, KeysOfJointsAndPluginsAreNoContacts) {
  EXPECT_TRUE(found(arm("") + "<gazebo reference='free'><kp>1e6</kp></gazebo><gazebo "
                              "reference='arm'><plugin name='p'><kp>3</kp></plugin></gazebo>")
                  .empty());
}

TEST(ForeignContacts, OfALinkThatTouchesSayNothing) {
  EXPECT_TRUE(found(arm("") +
                    "<gazebo reference='arm'><kp>1e6</kp></gazebo><codesign:contact name='c' "
                    "stiffness='1e6'><predecessor link='ground' shape='plane'/><successor "
                    "link='arm' shape='sphere' radius='0.1'/></codesign:contact>")
                  .empty());
}

TEST(ForeignContacts, ACopiedStiffnessIsOfALinearSpring) {
  expect_says(arm("<contact><stiffness value='500'/></contact>"),
              {"stiffness=\"500\" dissipation=\"...\" exponent=\"1\""});
  expect_says(arm("<contact><drake:point_contact_stiffness value='7'/></contact>"),
              {"stiffness=\"7\"", "exponent=\"1\""});
}

TEST(ForeignContacts, NumbersThatNoContactMayHaveAreToBeFilledIn) {
  const std::string text =
      arm("<contact><stiffness value='0'/><restitution value='0'/><lateral_friction "
          "value='-1'/></contact>");
  expect_says(text, {"stiffness=\"...\" restitution=\"...\"", "mu_static=\"...\""});
  EXPECT_EQ(found(text).at(0).message.find("exponent"), std::string::npos);
}

TEST(ForeignContacts, OtherConstraintsOfMuJoCoAreNoContacts) {
  EXPECT_TRUE(found(arm("") +
                    "<mujoco><equality><weld solref='0.01 1' solimp='1 1 1'/></equality><tendon>"
                    "<fixed solimp='1 1 1'/></tendon><default><equality solref='0.1 1'/></default>"
                    "</mujoco>")
                  .empty());
}

}  // namespace
}  // namespace codesign
