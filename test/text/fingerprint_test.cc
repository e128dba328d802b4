// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/fingerprint.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Fingerprint, IsFnv1a) {
  // The test vectors that Noll publishes.
  EXPECT_EQ(fingerprint(""), "cbf29ce484222325");
  EXPECT_EQ(fingerprint("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(fingerprint("foobar"), "85944171f73967e8");
}

TEST(Fingerprint, CountsEveryByte) { EXPECT_NE(fingerprint(std::string("\xff\0", 2)), fingerprint("\xff")); }

}  // namespace
}  // namespace codesign
