// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/message_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "jobs/result_fields.h"
#include "mechanism_codesign/IdentifiedNumber.h"
#include "mechanism_codesign/OptimizeResult.h"
#include "mechanism_codesign/Validation.h"
#include "mechanism_codesign/Warning.h"
#include "mechanism_codesign/WatchedSignal.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

TEST(MessageFields, NamesAreThoseOfTheDefinition) {
  EXPECT_EQ(names_of_fields("# text\n\nuint8 kOne=1\nstring kText=a b\nfloat64 x   # [m]\n"
                            "std_msgs/Header header\nPoint[] list\n====\nMSG: other\nint32 y\n"),
            (Names{"x", "header", "list"}));
}

TEST(MessageFields, AreSetByTheirNames) {
  const Validation validation{100, 2, 1.5, 1.75, 1.25, 3.25, 2.5, 0.875};
  mechanism_codesign::Validation message;
  set_fields(validation, &message);
  EXPECT_EQ(message.samples, 100U);
  EXPECT_EQ(message.promised, 1.5);
  EXPECT_EQ(message.within, 0.875);
  mechanism_codesign::OptimizeResult result;
  result.termination = "stays";
  Statistics statistics;
  statistics.steps = 5000000000;
  set_fields(statistics, &result);
  EXPECT_EQ(result.steps, 5000000000U);
  EXPECT_EQ(result.termination, "stays");
}

TEST(MessageFields, WhatIsNullInADocumentIsANumber) {
  WatchedResult watched;
  watched.signal = "crank/position";
  watched.upper = 2.0;
  mechanism_codesign::WatchedSignal signal;
  set_fields(watched, &signal);
  EXPECT_EQ(signal.signal, "crank/position");
  EXPECT_EQ(signal.upper, 2.0);
  EXPECT_TRUE(std::isinf(signal.lower));
  IdentifiedNumber number;
  number.is_on_bound = true;
  mechanism_codesign::IdentifiedNumber identified;
  set_fields(number, &identified);
  EXPECT_TRUE(std::isnan(identified.deviation));
  EXPECT_TRUE(identified.on_bound);
}

/// A result whose field has another type than that of the message.
struct Misfit {
  std::string samples;
};
constexpr auto fields_of(const Misfit*) {
  return std::make_tuple(field("samples", &Misfit::samples));
}

TEST(MessageFields, AnotherTypeIsRefused) {
  mechanism_codesign::Validation message;
  EXPECT_THROW(set_fields(Misfit{"many"}, &message), std::logic_error);
}

/// The fields of a message that no row of the result sets.
template <class Record, class Message>
std::set<std::string> not_set() {
  const Names names = names_of_fields(ros::message_traits::Definition<Message>::value());
  std::set<std::string> left(names.begin(), names.end());
  for_each_field<Record>([&left](const auto& row) { left.erase(row.name); });
  return left;
}

TEST(MessageFields, AFieldWithoutARowIsSetByHand) {
  using Set = std::set<std::string>;
  EXPECT_EQ((not_set<Validation, mechanism_codesign::Validation>()), Set());
  EXPECT_EQ((not_set<Warning, mechanism_codesign::Warning>()), Set());
  EXPECT_EQ((not_set<WatchedResult, mechanism_codesign::WatchedSignal>()),
            (Set{"largest_scenario", "smallest_scenario"}));
  EXPECT_EQ((not_set<IdentifiedNumber, mechanism_codesign::IdentifiedNumber>()),
            (Set{"high", "low", "lower", "name", "profile_high", "profile_low", "upper"}));
}

}  // namespace
}  // namespace codesign
