// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "engine/bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace codesign {

/// A structure as messages have them.
struct Sample {
  std::string name;
  std::vector<double> values;
  bool is_last = false;
};
template <class Bytes>
void members(Bytes& bytes, Sample& sample) {
  bytes(sample.name, sample.values, sample.is_last);
}

namespace {

TEST(Bytes, WhatIsWrittenIsRead) {
  const std::vector<double> numbers{1.0, std::numeric_limits<double>::lowest()};
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(3, 2);
  ByteWriter writer;
  writer(std::uint8_t{200}, -1.5, std::string("a\0b", 3), numbers, std::vector<double>{}, matrix,
         Eigen::MatrixXd(0, 4), std::vector<Sample>{{"one", numbers, false}, {"", {}, true}}, true);
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  EXPECT_EQ(reader.get<std::uint8_t>(), 200);
  EXPECT_EQ(reader.get<double>(), -1.5);
  EXPECT_EQ(reader.get<std::string>(), std::string("a\0b", 3));
  EXPECT_EQ(reader.get<std::vector<double>>(), numbers);
  EXPECT_TRUE(reader.get<std::vector<double>>().empty());
  EXPECT_EQ(reader.get<Eigen::MatrixXd>(), matrix);
  EXPECT_EQ(reader.get<Eigen::MatrixXd>().size(), 0);
  const auto samples = reader.get<std::vector<Sample>>();
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[0].name, "one");
  EXPECT_EQ(samples[0].values, numbers);
  EXPECT_TRUE(samples[1].is_last);
  EXPECT_FALSE(reader.at_end());
  EXPECT_TRUE(reader.get<bool>());
  EXPECT_TRUE(reader.at_end());
  EXPECT_THROW(reader.get<char>(), std::runtime_error);
}

TEST(Bytes, ASizeBeyondTheEndReservesNothing) {
  ByteWriter writer;
  writer(std::numeric_limits<std::uint64_t>::max());
  const std::string bytes = writer.take();
  EXPECT_THROW(ByteReader(bytes).get<std::string>(), std::runtime_error);
  EXPECT_THROW(ByteReader(bytes).get<std::vector<double>>(), std::runtime_error);
  EXPECT_THROW(ByteReader(bytes).get<std::vector<Sample>>(), std::runtime_error);
}

}  // namespace
}  // namespace codesign
