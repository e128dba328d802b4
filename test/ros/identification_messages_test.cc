// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/identification_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "identification/swinging_arm.h"

namespace codesign {
namespace {

TEST(IdentificationMessage, SaysWhatIsNotKnown) {
  IdentificationResult result;
  result.status = {StatusCode::kNotIdentifiable, 0.0, "the data do not determine all numbers"};
  IdentifiedNumber bound, unknown, profiled;
  bound.is_on_bound = true;
  unknown.is_determined = false;
  unknown.deviation = std::numeric_limits<double>::infinity();
  profiled.profile.emplace();
  profiled.profile->lower = 0.25;
  profiled.profile->upper = 0.75;
  profiled.profile->lower_end = ProfileEnd::kFound;
  profiled.profile->upper_end = ProfileEnd::kFailed;
  result.numbers = {bound, unknown, profiled};
  result.covariance = Eigen::MatrixXd::Identity(3, 3);
  result.covariance(0, 1) = 5.0;
  const auto message = identification_message(swinging_problem(), result);
  EXPECT_FALSE(message.success);
  EXPECT_EQ(message.code, "not_identifiable");
  EXPECT_EQ(message.message, "the data do not determine all numbers");
  EXPECT_TRUE(std::isnan(message.numbers[0].deviation) && std::isnan(message.numbers[0].low) && std::isnan(message.numbers[0].high));
  EXPECT_FALSE(message.numbers[1].determined);
  EXPECT_TRUE(std::isinf(message.numbers[1].deviation));
  EXPECT_TRUE(std::isnan(message.numbers[1].profile_low));
  EXPECT_EQ(message.numbers[2].profile_low, 0.25);
  EXPECT_TRUE(std::isnan(message.numbers[2].profile_high));
  EXPECT_EQ(message.covariance[1], 5.0) << "row by row";
  EXPECT_EQ(message.level, 0.95);
  EXPECT_EQ(message.noise, "correlated");
  EXPECT_TRUE(message.parameters.empty()) << "without values";
}

}  // namespace
}  // namespace codesign
