// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/xml/xml_document.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(XmlDocument, ADeclarationAfterACommentIsReadWithAWarning) {
  const XmlDocument late(
      {"a.urdf",
       "<!-- by\n us -->\n<?xml version=\"1.0\"?>\n<robot name=\"x\">\n<link/>\n</robot>"});
  ASSERT_EQ(late.warnings().size(), 1U);
  EXPECT_EQ(late.warnings()[0].code, "late_declaration");
  EXPECT_EQ(late.warnings()[0].where.line, 3);
  EXPECT_EQ(late.location(late.robot()->FirstChildElement()).line, 5);
  const XmlDocument usual({"a.urdf", "<?xml version=\"1.0\"?><!-- by us --><robot name=\"x\"/>"});
  EXPECT_TRUE(usual.warnings().empty());
  expect_error({"a.urdf", "<robot name=\"x\"/><?xml version=\"1.0\"?>"},
               {"declaration is malformed or not at the beginning"});
}

TEST(XmlDocument, CopiesKeepTheirPlaceOfOrigin) {
  XmlDocument base({"base.urdf", "<robot>\n<link/>\n</robot>"});
  const XmlDocument other(
      {"other.urdf", "<robot>\n\n<link\n a=\"1\"><mass\n b=\"2\"/></link>\n</robot>"});
  const tinyxml2::XMLElement* own = base.robot()->FirstChildElement();
  const tinyxml2::XMLElement* copy =
      base.append_copy(base.robot(), other.robot()->FirstChildElement(), other);
  EXPECT_EQ(base.location(own).file, "base.urdf");
  EXPECT_EQ(base.location(own).line, 2);
  EXPECT_EQ(base.location(copy).file, "other.urdf");
  EXPECT_EQ(base.location(copy).line, 3);
  EXPECT_EQ(base.location(copy->FirstChildElement(), "b").line, 5);
  EXPECT_EQ(base.location(copy, "missing").line, 3);
}

TEST(XmlDocument, AttributesRememberWhoSetThem) {
  XmlDocument base({"base.urdf", "<robot>\n<link a=\"1\" c=\"3\"/>\n</robot>"});
  const XmlDocument other({"other.urdf", "<robot>\n\n\n<link a=\"2\"/>\n</robot>"});
  tinyxml2::XMLElement* own = base.robot()->FirstChildElement();
  base.copy_attributes(own, other.robot()->FirstChildElement(), other);
  EXPECT_STREQ(own->Attribute("a"), "2");
  EXPECT_EQ(base.location(own, "a").file, "other.urdf");
  EXPECT_EQ(base.location(own, "a").line, 4);
  EXPECT_EQ(base.location(own, "c").file, "base.urdf");
}

}  // namespace
}  // namespace codesign
