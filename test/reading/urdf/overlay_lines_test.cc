// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/overlay_lines.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(OverlayLines, CommentsEndWhereTheyShould) {
  OverlayLines lines;
  lines.say("a---b");
  lines.add("<x/>");
  lines.to_fill_in("<y/>");
  EXPECT_EQ(lines.text(), "\n  <!-- a- - -b -->\n  <x/>\n  <!-- <y/> -->\n");
}

TEST(OverlayLines, AttributesStandInAnyElement) {
  EXPECT_EQ(attribute_text("a<b & \"c\"--d"), "\"a&lt;b &amp; &quot;c&quot;-&#45;d\"");
  EXPECT_EQ(element_named("link", "a", "<b/>"), "<link name=\"a\"><b/></link>");
}

}  // namespace
}  // namespace codesign
