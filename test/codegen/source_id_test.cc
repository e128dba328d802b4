// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/source_id.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(SourceId, GivesTheObjectBackAsItsOwnTypeOnly) {
  struct Holder {
    int first = 3;
  } holder;
  const SourceId id(holder);
  ASSERT_NE(id.as<Holder>(), nullptr);
  EXPECT_EQ(id.as<Holder>()->first, 3);
  EXPECT_EQ(id.as<int>(), nullptr);
  EXPECT_TRUE(id == SourceId(holder));
  EXPECT_FALSE(id == SourceId(holder.first)) << "the same address, but another type";
}

}  // namespace
}  // namespace codesign
