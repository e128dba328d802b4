// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/read_context.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(ReadContext, FindsLinksAndEnds) {
  const XmlDocument document({"a.urdf", "<robot><predecessor link=\"b\"/>\n<successor link=\"a\"/></robot>"});
  const XmlElement robot(document.robot(), &document);
  const ReadContext context{{"a", "b"}, {}};
  EXPECT_EQ(context.link(robot.only("successor"), "link"), 0);
  EXPECT_EQ(context.ends(robot), (std::pair<int, int>{1, 0}));
  const ReadContext other{{"b", "c"}, {}};
  EXPECT_THROW(other.link(robot.only("successor"), "link"), InputError);
}

TEST(ReadContext, EndsMustDiffer) {
  const XmlDocument document({"a.urdf", "<robot><predecessor link=\"a\"/>\n<successor link=\"a\"/></robot>"});
  const ReadContext context{{"a", "b"}, {}};
  try {
    context.ends(XmlElement(document.robot(), &document));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.line, 2);
  }
}

}  // namespace
}  // namespace codesign
