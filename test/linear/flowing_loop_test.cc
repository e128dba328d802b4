// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/flowing_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "linear/flowing_cases.h"
#include "linear/measure_derivatives.h"
#include "math/differences.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

using Kind = LinearMeasure::Kind;

/// Compares the margins of a cart's loop with those that it has beside a cart whose sampled loop it
/// does not know. @returns how many there are.
int compare_with_alone(const std::string& servo, double damping = 1.0) {
  const ControllerLoop alone = model_of(carts(1, {damped(damping)}), controlled(servo)).loops.at(0);
  const ControllerLoop beside =
      model_of(carts(2, {damped(damping), damped(2.0)}),
               controlled(servo + ", " +
                          cart_servo("gains: {p: 0.5}, sample_time: 0.5, delay: 0.2", "1")))
          .loops.at(0);
  EXPECT_EQ(alone.samples, 1);
  EXPECT_EQ(beside.samples, 0);
  EXPECT_FALSE(beside.frequencies.empty());
  int compared = 0;
  visit_margins(alone.margins, [&](const std::string& name, const auto& expected, const char*) {
    visit_margins(beside.margins, [&](const std::string& other, const auto& found, const char*) {
      if (name != other) return;
      ASSERT_EQ(expected.has_value(), found.has_value()) << name;
      if (!expected) return;
      ++compared;
      EXPECT_NEAR(found->value, expected->value, 1e-8 * expected->value) << name;
      EXPECT_NEAR(found->frequency, expected->frequency, 1e-4 * expected->frequency) << name;
    });
  });
  return compared;
}

// Also where a period is longer than the turns of the loop, and where its output depends on itself
// at once, through an acceleration.
TEST(FlowingLoop, OfALoopThatSamplesDoNotTouchIsItsTransferFunction) {
  EXPECT_EQ(compare_with_alone(cart_servo("gains: {p: 900, i: 100, d: 12}, time_constant: 0.01, "
                                          "derivative_filter: 0.005")),
            6);
  EXPECT_EQ(compare_with_alone("servo0: {type: pid, input: \"${x0/position + 0.1*x0/velocity + "
                               "0.01*x0/acceleration}\", setpoint: 0, output: x0, gains: {p: 40}}"),
            5);
  EXPECT_EQ(compare_with_alone("servo0: {type: pid, input: \"${0.05*x0/velocity - "
                               "0.5*x0/acceleration}\", setpoint: 0, output: x0, gains: {p: 1}}",
                               40.0),
            3);
}

/// C/(s - A) + D over a period of 1 s at whose instants nothing happens.
ComplexSpace first_order(double A, std::complex<double> C, std::complex<double> D) {
  const auto one = [](std::complex<double> value) {
    return Eigen::MatrixXcd::Constant(1, 1, value);
  };
  return {one(A), one(1.0), one(C), one(D), {{{Eigen::MatrixXcd::Identity(1, 2), 1.0}}, {0}}};
}

// As LoopMargins.OfAnOutputThatDependsOnItselfAtOnce; d(1 + 1/D) = -dD/D^2.
TEST(FlowingLoop, OfAnOutputThatDependsOnItselfAtOnce) {
  const std::complex<double> step(0.0, ComplexSpace::kStep);
  const LoopMargins below = FlowingLoop(first_order(-8.0, -14.0, 1.0)).margins();
  ASSERT_TRUE(below.is_stable && below.gain_margin && below.delay_margin);
  EXPECT_NEAR(below.gain_margin->value, 2.0, 1e-12);
  EXPECT_GT(below.gain_margin->frequency, 1e3);
  EXPECT_FALSE(below.gain_reduction);
  EXPECT_GT(below.delay_margin->value, 0.0);
  const LoopMargins beyond = FlowingLoop(first_order(-4.0, 6.0, -3.0)).margins();
  ASSERT_TRUE(beyond.is_stable && beyond.gain_reduction && beyond.delay_margin);
  EXPECT_NEAR(beyond.gain_reduction->value, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(beyond.delay_margin->value, 0.0);
  const LoopMargins unstable = FlowingLoop(first_order(20.0, -42.0, -3.0)).margins();
  ASSERT_TRUE(unstable.gain_reduction);
  EXPECT_FALSE(unstable.is_stable || unstable.delay_margin);
  EXPECT_NEAR(unstable.gain_reduction->value, 2.0 / 3.0, 1e-12);
  for (const double period : {0.0, 1.0}) {
    ComplexSpace moving = first_order(-4.0, 6.0 + 5.0 * step, -3.0 + 2.0 * step);
    if (period == 0.0) moving.pieces = {};
    EXPECT_NEAR(derivative_of(*beyond.gain_reduction, Kind::kGainReduction, 0.0, moving, period),
                -2.0 / 9.0, 1e-14);
    EXPECT_EQ(derivative_of(*beyond.delay_margin, Kind::kDelayMargin, 0.0, moving, period), 0.0);
  }
}

// S = 1, T = 0: no peak of rounding.
TEST(FlowingLoop, WithoutGains) {
  ComplexSpace cart = damped_cart();
  cart.C.setZero();
  cart.A.row(2).setZero();
  cart.A(2, 2) = -20.0;
  const LoopMargins margins = FlowingLoop(cart).margins();
  EXPECT_EQ(margins.sensitivity->value, 1.0);
  EXPECT_EQ(margins.complementary->value, 0.0);
  EXPECT_FALSE(margins.gain_margin || margins.phase_margin || margins.bandwidth);
}

// The figures of scipy: expm, eigvals and brentq for factors on the unit circle and the real axis;
// responses by shooting, norms of 128 constant parts per period by numpy.
TEST(FlowingLoop, OfADampedCart) {
  const FlowingLoop loop(damped_cart());
  const LoopMargins margins = loop.margins();
  EXPECT_TRUE(margins.is_stable);
  EXPECT_NEAR(margins.gain_margin->value, 9.815765658146304, 1e-9);
  EXPECT_FALSE(margins.gain_reduction);
  EXPECT_NEAR(margins.phase_margin->value, 1.365918619018097, 1e-10);
  EXPECT_NEAR(margins.phase_margin->frequency, 3.1866797516609333, 1e-9);
  EXPECT_NEAR(margins.delay_margin->value, 0.4286337898579751, 1e-10);
  EXPECT_NEAR(margins.sensitivity->value, 1.32442017, 1e-7);
  EXPECT_NEAR(margins.complementary->value, 1.00092168, 1e-7);
  EXPECT_NEAR(margins.bandwidth->value, 4.3840334, 1e-4);
  EXPECT_NEAR(std::abs(loop.at(5.0) - std::complex<double>(-0.23252838, -0.62124265)), 0.0, 1e-6);
}

// What linearize() makes of the same cart, with poles on both sides of its margin.
TEST(FlowingLoop, AtItsGainMarginAPoleIsOnTheCircle) {
  const auto model = [](double factor) {
    const std::string gain = std::to_string(20.0 * factor), rate = std::to_string(factor);
    return model_of(
        carts(1, {damped(0.5)}),
        controlled(cart_servo("gains: {p: " + gain + ", d: " + rate + "}, time_constant: 0.05") +
                   ", damper: {type: pid, input: x0/velocity, setpoint: 0, output: x0, "
                   "gains: {p: 6}, sample_time: 0.1, delay: 0.05}"));
  };
  const double margin = model(1.0).loops.at(0).margins.gain_margin->value;
  EXPECT_NEAR(margin, 9.815765658146304, 1e-8);
  EXPECT_EQ(model(margin * 0.9999).stability, Stability::kStable);
  EXPECT_EQ(model(margin * 1.0001).stability, Stability::kUnstable);
  const LoopMargins beyond = model(margin * 1.1).loops.at(0).margins;
  EXPECT_FALSE(beyond.is_stable || beyond.gain_margin || beyond.sensitivity);
  EXPECT_NEAR(beyond.gain_reduction->value, 1.0 / 1.1, 2e-6);
}

TEST(FlowingLoop, Derivatives) {
  const LoopMargins margins = FlowingLoop(damped_cart()).margins();
  const FlowingLoop moving(moving_cart());
  std::map<double, LoopMargins> known;
  const auto margins_at = [&known](double step) -> const LoopMargins& {
    const auto found = known.find(step);
    return found != known.end() ? found->second
                                : known[step] = FlowingLoop(damped_cart(step)).margins();
  };
  for (const Kind kind : {Kind::kGainMargin, Kind::kPhaseMargin, Kind::kDelayMargin,
                          Kind::kBandwidth, Kind::kSensitivity, Kind::kComplementarySensitivity}) {
    const std::vector<AtFrequency> all = margins_of(margins, kind);
    ASSERT_FALSE(all.empty()) << static_cast<int>(kind);
    const RiddersDerivative reference = ridders_derivative(
        [&](double step) { return margins_of(margins_at(step), kind).front().value; }, 0.0, 0.02);
    EXPECT_NEAR(moving.derivative_of(all.front(), kind, margins.rest), reference.value,
                1e-7 * (1.0 + std::abs(reference.value)) + 10.0 * reference.error)
        << static_cast<int>(kind);
    EXPECT_LT(reference.error, 1e-6 * (1.0 + std::abs(reference.value)));
  }
}

// A sampler sees at once what the signal moves: no norm bounds that.
TEST(FlowingLoop, HasNoSensitivityWhereASampleReadsTheSignal) {
  ComplexSpace cart = damped_cart();
  cart.pieces.different[0].jump(4, 5) = 0.1;
  const LoopMargins margins = FlowingLoop(cart).margins();
  EXPECT_FALSE(margins.sensitivity || margins.complementary);
  EXPECT_TRUE(margins.phase_margin && margins.bandwidth);
}

}  // namespace
}  // namespace codesign
