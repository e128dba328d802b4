// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/node_table.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(NodeTable, FindsWhatItHoldsAlsoAfterItHasGrown) {
  constexpr int kCount = 50000;
  const auto key = [](int k) { return (static_cast<std::uint64_t>(k % 7 + 2) << 58U) | static_cast<std::uint64_t>(k + 1); };
  NodeTable table;
  for (int k = 0; k < kCount; ++k) EXPECT_EQ(table.find_or_add(key(k), 3 * k), std::make_pair(3 * k, true));
  for (int k = 0; k < kCount; ++k) EXPECT_EQ(table.find_or_add(key(k), -1), std::make_pair(3 * k, false));
}

}  // namespace
}  // namespace codesign
