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

TEST(Fingerprint, AChecksumFindsEveryChangedByte) {
  const std::string text = with_checksum("{\"a\":[1,2.5]}");
  EXPECT_EQ(text, "{\"a\":[1,2.5],\"checksum\":\"" + fingerprint("{\"a\":[1,2.5]") + "\"}");
  EXPECT_TRUE(has_right_checksum(text));
  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string changed = text;
    for (const int bit : {1, 4, 128}) {
      changed[k] = static_cast<char>(text[k] ^ bit);
      EXPECT_FALSE(has_right_checksum(changed)) << changed;
    }
    EXPECT_FALSE(has_right_checksum(text.substr(0, k)));
  }
}

TEST(Fingerprint, CountsEveryByte) {
  EXPECT_NE(fingerprint(std::string("\xff\0", 2)), fingerprint("\xff"));
}

}  // namespace
}  // namespace codesign
