// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/message_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "jobs/result_fields.h"
#include "mechanism_codesign/Evaluate.h"
#include "mechanism_codesign/IdentifiedNumber.h"
#include "mechanism_codesign/IdentifyResult.h"
#include "mechanism_codesign/OptimizeResult.h"
#include "mechanism_codesign/Optimum.h"
#include "mechanism_codesign/OutputFit.h"
#include "mechanism_codesign/ScenarioResult.h"
#include "mechanism_codesign/SearchResult.h"
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

using Set = std::set<std::string>;

/// The fields of a message that no row of the results sets, and the rows that it does not have.
struct Difference {
  Set by_hand, not_sent;

  template <class Record>
  Difference& with() {
    for_each_field<Record>([this](const auto& row) {
      if (by_hand.erase(row.name) == 0) not_sent.insert(row.name);
    });
    return *this;
  }
};
template <class Message>
Difference of() {
  const Names names = names_of_fields(ros::message_traits::Definition<Message>::value());
  return {Set(names.begin(), names.end()), {}};
}

// The line of a .msg file is part of a contract with clients and comes before any program, so that
// it does not follow from the row. A new row is therefore either a line there or a name here.
TEST(MessageFields, ARowIsSentOrIsNamedHere) {
  namespace m = mechanism_codesign;
  EXPECT_EQ(of<m::Validation>().with<Validation>().not_sent, Set());
  EXPECT_EQ(of<m::Warning>().with<Warning>().not_sent, (Set{"file", "line"}));  // in the message
  EXPECT_EQ(of<m::WatchedSignal>().with<WatchedResult>().not_sent, (Set{"tolerance"}));
  EXPECT_EQ(of<m::IdentifiedNumber>().with<IdentifiedNumber>().not_sent,
            (Set{"profile"}));  // its ends are set by hand
  EXPECT_EQ(of<m::ScenarioResult>().with<ScenarioResult>().not_sent, Set());
  EXPECT_EQ(of<m::SearchResult>().with<StartResult>().not_sent, (Set{"status"}));  // code
  EXPECT_EQ(of<m::Optimum>().with<Optimum>().not_sent, Set());
  EXPECT_EQ(of<m::OutputFit>().with<OutputFit>().with<Whiteness>().not_sent,
            (Set{"counted", "explained", "lags", "ljung_box", "probability"}));  // share, whiteness
  EXPECT_EQ(of<m::OptimizeResult>().with<SearchCost>().with<Statistics>().not_sent,
            (Set{"explicit_steps"}));
  EXPECT_EQ(of<m::EvaluateResponse>().with<Statistics>().not_sent, (Set{"explicit_steps"}));
  EXPECT_EQ(of<m::IdentifyResult>().with<IdentificationResult>().not_sent, Set());
}

TEST(MessageFields, AFieldWithoutARowIsSetByHand) {
  namespace m = mechanism_codesign;
  EXPECT_EQ(of<m::Validation>().with<Validation>().by_hand, Set());
  EXPECT_EQ(of<m::Warning>().with<Warning>().by_hand, Set());
  EXPECT_EQ(of<m::WatchedSignal>().with<WatchedResult>().by_hand,
            (Set{"largest_scenario", "smallest_scenario"}));
  EXPECT_EQ(of<m::IdentifiedNumber>().with<IdentifiedNumber>().by_hand,
            (Set{"high", "low", "lower", "name", "profile_high", "profile_low", "upper"}));
  EXPECT_EQ(of<m::ScenarioResult>().with<ScenarioResult>().by_hand, (Set{"parameters", "values"}));
  EXPECT_EQ(of<m::SearchResult>().with<StartResult>().by_hand,
            (Set{"code", "end", "message", "start"}));
  EXPECT_EQ(of<m::Optimum>().with<Optimum>().by_hand, (Set{"values"}));
  EXPECT_EQ(of<m::OutputFit>().with<OutputFit>().with<Whiteness>().by_hand,
            (Set{"joint", "whiteness"}));
}

}  // namespace
}  // namespace codesign
