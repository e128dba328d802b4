// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply_options.h"

#include <gtest/gtest.h>

#include <limits>

#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

using mechanism_codesign::ApplyRequest;

template <class Read>
std::string refusal_of(const Read& read, const ApplyRequest& request) {
  try {
    read(request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ApplyOptions, ZeroIsTheDefault) {
  EXPECT_EQ(ramp_options({}).ramp, 2.0);
  EXPECT_EQ(ramp_options({}).hold, 1.0);
  EXPECT_EQ(watch_options({}).max_age, 0.5);
  EXPECT_EQ(watch_options({}).joint_states, "joint_states");
}

TEST(ApplyOptions, ATimeThatIsNoneIsRefusedWithItsRange) {
  for (double ApplyRequest::*field : {&ApplyRequest::ramp, &ApplyRequest::hold, &ApplyRequest::max_age}) {
    const auto read = [](const ApplyRequest& request) {
      ramp_options(request);
      watch_options(request);
    };
    ApplyRequest request;
    request.*field = 1e5;
    EXPECT_EQ(refusal_of(read, request), "accepted");
    for (const double wrong : {100000.5, 2e8, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      request.*field = wrong;
      const std::string sentence = refusal_of(read, request);
      EXPECT_NE(sentence.find("not a time"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("up to 100000 s"), std::string::npos) << sentence;
    }
  }
}

TEST(ApplyOptions, NothingIsBothNamedAndUnwatched) {
  ApplyRequest request;
  request.unwatched = true;
  EXPECT_EQ(watch_options(request).joint_states, "");
  request.deviation = 0.1;
  EXPECT_NE(refusal_of(watch_options, request).find("left unwatched"), std::string::npos);
  request.unwatched = false;
  EXPECT_EQ(watch_options(request).deviation, 0.1);
  request.deviation = -0.1;
  EXPECT_NE(refusal_of(watch_options, request).find("deviation"), std::string::npos);
}

}  // namespace
}  // namespace codesign
