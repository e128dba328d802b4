// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace codesign {
namespace {

TEST(Bytes, WhatIsWrittenIsRead) {
  ByteWriter writer;
  writer.add(std::uint8_t{200});
  writer.add(-1.5);
  writer.add_text("a\0b");
  writer.add_text(std::string("a\0b", 3));
  writer.add_numbers(std::vector<double>{1.0, std::numeric_limits<double>::lowest()});
  writer.add_numbers(std::vector<double>{});
  writer.add(true);
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  EXPECT_EQ(reader.get<std::uint8_t>(), 200);
  EXPECT_EQ(reader.get<double>(), -1.5);
  EXPECT_EQ(reader.get_text(), "a");
  EXPECT_EQ(reader.get_text().size(), 3U);
  EXPECT_EQ(reader.get_numbers<std::vector<double>>()[1], std::numeric_limits<double>::lowest());
  EXPECT_TRUE(reader.get_numbers<std::vector<double>>().empty());
  EXPECT_FALSE(reader.at_end());
  EXPECT_TRUE(reader.get<bool>());
  EXPECT_TRUE(reader.at_end());
  EXPECT_THROW(reader.get<char>(), std::runtime_error);
}

TEST(Bytes, ASizeBeyondTheEndReservesNothing) {
  ByteWriter writer;
  writer.add(std::numeric_limits<std::uint64_t>::max());
  const std::string bytes = writer.take();
  EXPECT_THROW(ByteReader(bytes).get_text(), std::runtime_error);
  EXPECT_THROW(ByteReader(bytes).get_numbers<std::vector<double>>(), std::runtime_error);
}

}  // namespace
}  // namespace codesign
