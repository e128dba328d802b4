// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/settled_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "integration/servo.h"

namespace codesign {
namespace {

struct Calls {
  const std::shared_ptr<const CompiledSystem> system = servo("{}");
  SettledStart start;
  std::string seen;  ///< how much the first parameter of each begin exceeds the study's, and "s" for each settle
  bool fails = false;

  Status run(double excess) {
    const double own = system->parameters().front();
    const auto begin = [this, own](const std::vector<double>& parameters) {
      seen += std::to_string(std::lround(parameters.front() - own));
      return fails ? Status{StatusCode::kSingularMatrix, 0.0, "as asked"} : Status{};
    };
    std::vector<double> parameters = system->parameters();
    parameters.front() += excess;
    return start.start(*system, parameters, begin, [this] { seen += "s"; });
  }
};

TEST(SettledStart, SettlesAtTheOwnStartOnce) {
  Calls calls;
  EXPECT_TRUE(calls.run(2.0).ok());
  calls.run(3.0);
  calls.run(0.0);
  EXPECT_EQ(calls.seen, "0s230");
}

TEST(SettledStart, BeginsTheOwnStartOnceIfItIsTheFirst) {
  Calls calls;
  calls.run(0.0);
  calls.run(2.0);
  EXPECT_EQ(calls.seen, "0s2");
}

TEST(SettledStart, AStartThatFailsSettlesNothing) {
  Calls calls;
  calls.fails = true;
  EXPECT_EQ(calls.run(2.0).code, StatusCode::kSingularMatrix);
  EXPECT_EQ(calls.seen, "02");
}

}  // namespace
}  // namespace codesign
