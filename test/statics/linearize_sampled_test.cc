// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "statics/linear_cases.h"

namespace codesign {
namespace {

// The transfer function 2/(s (s + 1)(s + 2)) between zero-order hold and samples of 0.05 s.
TEST(Linearize, ASampledLoopBesideItsGainMargin) {
  const auto sampled = [](double gain, const std::string& more = "") {
    return model_of(carts(1, {damped(1.0)}),
                    controlled(cart_servo("gains: {p: " + std::to_string(gain) +
                                          "}, time_constant: 0.5, sample_time: 0.05" + more)));
  };
  const LinearModel model = sampled(1.0);
  EXPECT_NEAR(model.loops.at(0).margins.gain_margin->value, 2.7928, 5e-5);
  EXPECT_EQ(model.system.period, 0.05);
  EXPECT_EQ(sampled(2.792).stability, Stability::kStable);
  EXPECT_EQ(sampled(2.793).stability, Stability::kUnstable);
  EXPECT_NE(model.verdict.find("samples counted, friction not"), std::string::npos);
  // A further delay of the delay margin brings it to its limit.
  const double delay = model.loops.at(0).margins.delay_margin->value;
  EXPECT_EQ(sampled(1.0, ", delay: " + std::to_string(delay - 1e-4)).stability, Stability::kStable);
  EXPECT_EQ(sampled(1.0, ", delay: " + std::to_string(delay + 1e-4)).stability,
            Stability::kUnstable);
}

// v(k+1) = v(k) - k T v(k): the pole 1 - k T, and with a delay of a sample z^2 - z + k T.
TEST(Linearize, ASampledSpeed) {
  const auto sampled = [](const std::string& more) {
    return model_of(carts(1, {""}),
                    "duration: 10\ncontrollers: {" +
                        cart_servo("gains: {p: 2}, sample_time: 0.1" + more, "0", "velocity") +
                        "}\n");
  };
  const LinearModel model = sampled("");
  EXPECT_NEAR(model.loops.at(0).margins.gain_margin->value, 10.0, 1e-9);
  // |0.2/(z - 0.8)|^2 = 1/2, whatever the position does
  EXPECT_NEAR(model.loops.at(0).margins.bandwidth->value, std::acos(0.975) / 0.1, 1e-7);
  const LinearModel late = sampled(", delay: 0.1");
  EXPECT_NEAR(late.loops.at(0).margins.gain_margin->value, 5.0, 1e-9);
  std::vector<double> radii;
  for (const LinearMode& mode : late.modes) radii.push_back(mode.pole.radius(0.1));
  std::sort(radii.begin(), radii.end());
  ASSERT_EQ(radii.size(), 3U);
  EXPECT_NEAR(radii[0], 0.5 - std::sqrt(0.05), 1e-12);
  EXPECT_NEAR(radii[1], 0.5 + std::sqrt(0.05), 1e-12);
  EXPECT_NEAR(radii[2], 1.0, 1e-9) << "the position drifts";
  // Three samples of delay: z^3 (z - 1) + k T = 0.
  const LinearModel later = sampled(", delay: 0.3");
  for (const LinearMode& mode : later.modes) {
    const std::complex<double> z = std::exp(mode.pole.value * 0.1);
    EXPECT_LT(std::abs((z * z * z * (z - 1.0) + 0.2) * (z - 1.0)), 1e-9);
  }
}

// Deadbeat: after two samples nothing is left.
TEST(Linearize, ADeadbeatLoopHasNoMotionLeft) {
  const LinearModel model =
      model_of(carts(1, {""}),
               "duration: 10\ncontrollers: {c: {type: state_feedback, output: x0, sample_time: "
               "0.5, feedback: "
               "[{signal: x0/position, gain: 4}, {signal: x0/velocity, gain: 3}]}}\n");
  EXPECT_EQ(model.stability, Stability::kStable);
  for (const LinearMode& mode : model.modes) EXPECT_LT(mode.pole.radius(0.5), 1e-6);
}

// Two speeds of their own, sampled every 0.02 s and 0.03 s: (1 - k T)^n over 0.06 s.
TEST(Linearize, SeveralSampleTimes) {
  const LinearModel model =
      model_of(carts(2, {"", ""}),
               controlled(cart_servo("gains: {p: 5}, sample_time: 0.02", "0", "velocity") + ", " +
                          cart_servo("gains: {p: 10}, sample_time: 0.03", "1", "velocity")));
  EXPECT_NEAR(model.system.period, 0.06, 1e-15);
  std::vector<double> radii;
  for (const LinearMode& mode : model.modes) radii.push_back(mode.pole.radius(model.system.period));
  std::sort(radii.begin(), radii.end());
  ASSERT_EQ(radii.size(), 4U);
  EXPECT_NEAR(radii[0], std::pow(0.7, 2), 1e-12);
  EXPECT_NEAR(radii[1], std::pow(0.9, 3), 1e-12);
  EXPECT_NEAR(model.loops.at(0).margins.gain_margin->value, 2.0 / 0.1, 1e-9);
  EXPECT_NEAR(model.loops.at(1).margins.gain_margin->value, 2.0 / 0.3, 1e-9);
}

}  // namespace
}  // namespace codesign
