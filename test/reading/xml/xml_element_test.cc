// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/xml/xml_element.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

const char kText[] =
    "<robot name=\"r\">\n<joint name=\"j\"><origin\n xyz=\"1\" "
    "rpy=\"\"/></joint><link/><link/></robot>";

class XmlElementTest : public ::testing::Test {
 protected:
  XmlDocument document_{{"a.urdf", kText}};
  XmlElement robot_{document_.robot(), &document_};
  XmlElement origin_ = robot_.only("joint").only("origin");
};

TEST_F(XmlElementTest, LabelsLeadFromTheRobotDown) {
  EXPECT_EQ(robot_.label(), "<robot name=\"r\">");
  EXPECT_EQ(origin_.label(), "<joint name=\"j\"> <origin>");
  EXPECT_EQ(origin_.where().line, 2);
  EXPECT_EQ(origin_.where("xyz").line, 3);
}

TEST_F(XmlElementTest, AttributesAreThereOrMissed) {
  EXPECT_EQ(origin_.text("xyz"), "1");
  EXPECT_EQ(origin_.find("none"), std::nullopt);
  EXPECT_EQ(origin_.attributes(), (std::vector<std::string>{"xyz", "rpy"}));
  EXPECT_THROW(origin_.text("none"), InputError);
  EXPECT_THROW(origin_.text("rpy"), InputError) << "empty";
}

TEST_F(XmlElementTest, ChildrenAreCounted) {
  EXPECT_EQ(robot_.children().size(), 3u);
  EXPECT_EQ(robot_.children("link").size(), 2u);
  EXPECT_FALSE(robot_.child("none"));
  EXPECT_EQ(robot_.child("link")->find("name"), robot_.children("link").front().find("name"))
      << "of several the first";
  EXPECT_THROW(robot_.only("none"), InputError);
}

TEST_F(XmlElementTest, FailuresNameThePlace) {
  try {
    origin_.fail_at("xyz", "too few values", "3");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a.urdf:3: <joint name=\"j\"> <origin>: too few values (value: 1, allowed: 3)");
  }
}

}  // namespace
}  // namespace codesign
