// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

std::string balanced(const std::string& gains) {
  return controlled(
      "balance: {type: state_feedback, output: x0, feedback: [{signal: x0/position}, "
      "{signal: x0/velocity}], gains: " +
      gains + "}");
}

Problem read(const std::string& gains) { return loaded(carts(1, {""}), balanced(gains)); }

// k1 = sqrt(q/r), k2 = sqrt(2 k1) of a double integrator.
TEST(StudyGains, DeclareAParameterForEachSignal) {
  const Problem problem =
      read("{from: lqr, weights: [4, 0], effort: 0.25, lower: -1, upper: 9, tune: false}");
  EXPECT_TRUE(problem.tuned_names().empty());
  const std::vector<Parameter>& all = problem.all_parameters();
  ASSERT_EQ(all.size(), 2U);
  const double expected[] = {4.0, std::sqrt(8.0)};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(all[k].name, "balance_k" + std::to_string(k));
    EXPECT_EQ(all[k].lower, -1.0);
    EXPECT_EQ(all[k].upper, 9.0);
    EXPECT_NEAR(all[k].value, expected[k], 1e-12);
  }
  EXPECT_EQ(read("{from: lqr, weights: [4, 0]}").tuned_names(),
            (std::vector<std::string>{"balance_k0", "balance_k1"}));
}

// (s + 2)^2 + 9.
TEST(StudyGains, APairIsTwoPoles) {
  const std::vector<double> gains = read("{from: poles, poles: [[-2, 3]]}").parameters();
  ASSERT_EQ(gains.size(), 2U);
  EXPECT_NEAR(gains[0], 13.0, 1e-12);
  EXPECT_NEAR(gains[1], 4.0, 1e-12);
}

TEST(StudyGains, RefuseWhatIsNoDesign) {
  const auto message = [](const std::string& gains) { return refused([&] { read(gains); }); };
  EXPECT_NE(message("{from: lqr, weights: [1, -1]}").find("a weight is negative"),
            std::string::npos);
  EXPECT_NE(message("{from: lqr, weights: [1, 1], effort: 0}").find("effort"), std::string::npos);
  EXPECT_NE(message("{from: lqr, poles: [-1, -2]}").find("weights"), std::string::npos);
  EXPECT_NE(message("{from: poles, poles: [[-1, 2, 3]]}").find("two numbers"), std::string::npos);
  EXPECT_NE(message("{from: riccati, weights: [1, 1]}").find("lqr"), std::string::npos);
  EXPECT_NE(refused([] {
              loaded(carts(1, {""}),
                     controlled("balance: {type: state_feedback, output: x0, feedback: [{signal: "
                                "x0/position, gain: 2}, {signal: x0/velocity}], gains: {from: lqr, "
                                "weights: [1, 1]}}"));
            }).find("gain"),
            std::string::npos);
}

}  // namespace
}  // namespace codesign
