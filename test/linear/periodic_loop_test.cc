// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/periodic_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "statics/linear_cases.h"

namespace codesign {
namespace {

// A cart whose loop knows nothing of another one, which is sampled half as often: margins are those
// of the transfer function that it has alone.
TEST(PeriodicLoop, OfALoopThatDoesNotChangeIsItsTransferFunction) {
  const std::string servo =
      cart_servo("gains: {p: 1.2, i: 0.1, d: 0.2}, time_constant: 0.5, sample_time: 0.05");
  const ControllerLoop alone = model_of(carts(1, {damped(1.0)}), controlled(servo)).loops.at(0);
  const ControllerLoop beside =
      model_of(carts(2, {damped(1.0), damped(0.5)}),
               controlled(servo + ", " + cart_servo("gains: {p: 2}, sample_time: 0.1", "1")))
          .loops.at(0);
  EXPECT_EQ(alone.samples, 1);
  EXPECT_EQ(beside.samples, 2);
  visit_margins(alone.margins, [&](const std::string& name, const auto& expected, const char*) {
    visit_margins(beside.margins, [&](const std::string& other, const auto& found, const char*) {
      if (name != other) return;
      ASSERT_EQ(expected.has_value(), found.has_value()) << name;
      if (!expected) return;
      EXPECT_NEAR(found->value, expected->value, 1e-8 * expected->value) << name;
      EXPECT_NEAR(found->frequency, expected->frequency, 1e-5 * expected->frequency) << name;
    });
  });
  EXPECT_FALSE(beside.frequencies.empty());
}

// v(k+1) = (1 - k T) v(k): k T = 2 is the limit, at half of the sampling rate.
TEST(PeriodicLoop, OfSpeedsByClosedForms) {
  const LinearModel model =
      model_of(carts(2, {"", ""}),
               controlled(cart_servo("gains: {p: 5}, sample_time: 0.02", "0", "velocity") + ", " +
                          cart_servo("gains: {p: 10}, sample_time: 0.03", "1", "velocity")));
  const std::vector<double> gains{5.0, 10.0}, times{0.02, 0.03};
  for (std::size_t k = 0; k < 2; ++k) {
    const LoopMargins& margins = model.loops.at(k).margins;
    EXPECT_EQ(model.loops[k].samples, k == 0 ? 3 : 2);
    const double T = times[k], loop = gains[k] * T;
    EXPECT_NEAR(margins.gain_margin->value, 2.0 / loop, 1e-9);
    EXPECT_NEAR(margins.gain_margin->frequency, kPi / T, 1e-6);
    // |loop/(z - 1)| = 1: 2 sin(w T/2) = loop, the phase -90 deg - w T/2.
    const double w = 2.0 * std::asin(0.5 * loop) / T;
    EXPECT_NEAR(margins.phase_margin->frequency, w, 1e-8);
    EXPECT_NEAR(margins.phase_margin->value, 0.5 * kPi - 0.5 * w * T, 1e-9);
    EXPECT_NEAR(margins.delay_margin->value, (0.5 * kPi - 0.5 * w * T) / w, 1e-9);
  }
}

// The speed of a cart is read by a fast controller, its position by a slow one: what the slow one
// does to the fast loop changes from sample to sample.
TEST(PeriodicLoop, AtItsGainMarginAPoleIsOnTheCircle) {
  const auto model = [](double gain) {
    return model_of(
        carts(1, {damped(0.5)}),
        controlled(cart_servo("gains: {p: " + std::to_string(5.0 * gain) + "}, sample_time: 0.05",
                              "0", "velocity") +
                   ", hold: {type: pid, input: x0/position, setpoint: 0, output: x0, "
                   "gains: {p: 4}, sample_time: 0.2}"));
  };
  const double margin = model(1.0).loops.at(0).margins.gain_margin->value;
  EXPECT_EQ(model(margin * 0.9999).stability, Stability::kStable);
  EXPECT_EQ(model(margin * 1.0001).stability, Stability::kUnstable);
  const LoopMargins beyond = model(margin * 1.1).loops.at(0).margins;
  EXPECT_FALSE(beyond.is_stable);
  EXPECT_FALSE(beyond.gain_margin);
  EXPECT_NEAR(beyond.gain_reduction->value, 1.0 / 1.1, 2e-6);
}

}  // namespace
}  // namespace codesign
