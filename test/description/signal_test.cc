// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/signal.h"
#include "description/study.h"

namespace codesign {
namespace {

SignalDescription parse(const std::string& text) {
  return parse_signal(text, {"study.yaml", 7}, "objective.integral[0].signal");
}

void expect_term(const SignalTerm& term, double factor, const char* object, const char* quantity,
                 const char* component) {
  EXPECT_EQ(term.factor, factor);
  EXPECT_EQ(term.object, object);
  EXPECT_EQ(term.quantity, quantity);
  EXPECT_EQ(term.component, component);
}

TEST(Signal, SplitsNameQuantityAndComponent) {
  const SignalDescription joint = parse("crank_joint/velocity");
  ASSERT_EQ(joint.terms.size(), 1U);
  expect_term(joint.terms[0], 1.0, "crank_joint", "velocity", "");
  EXPECT_EQ(joint.text, "crank_joint/velocity");
  EXPECT_EQ(joint.where.line, 7);
  expect_term(parse("plate/angular_velocity/z").terms.at(0), 1.0, "plate", "angular_velocity", "z");
}

TEST(Signal, ReadsSumsAndDifferences) {
  const auto terms = parse(" - plate/position/x + ball/position/x-crank_speed/error").terms;
  ASSERT_EQ(terms.size(), 3U);
  expect_term(terms[0], -1.0, "plate", "position", "x");
  expect_term(terms[1], 1.0, "ball", "position", "x");
  expect_term(terms[2], -1.0, "crank_speed", "error", "");
}

TEST(Signal, NamesMayHoldSignsAndBlanks) {
  const auto terms = parse("a-b/velocity-c-d/velocity + left arm/position").terms;
  ASSERT_EQ(terms.size(), 3U);
  expect_term(terms[0], 1.0, "a-b", "velocity", "");
  expect_term(terms[1], -1.0, "c-d", "velocity", "");
  expect_term(terms[2], 1.0, "left arm", "position", "");
}

TEST(Signal, NamesMayHoldSlashes) {
  const auto terms =
      parse("arm/1/position - left/elbow/velocity + base/tool/position/x-position/x/velocity/y")
          .terms;
  ASSERT_EQ(terms.size(), 4U);
  expect_term(terms[0], 1.0, "arm/1", "position", "");
  expect_term(terms[1], -1.0, "left/elbow", "velocity", "");
  expect_term(terms[2], 1.0, "base/tool", "position", "x");
  expect_term(terms[3], -1.0, "position/x", "velocity", "y");
}

TEST(Signal, ALinkBehindAnAtSignNamesTheAxes) {
  const auto terms = parse(
                         "a-b/reaction_force/x@left-arm - c/reaction_torque/z@ground-d/velocity/y"
                         "+left/elbow/reaction_force/x@left/fore.arm")
                         .terms;
  ASSERT_EQ(terms.size(), 4U);
  expect_term(terms[0], 1.0, "a-b", "reaction_force", "x");
  EXPECT_EQ(terms[0].axes, "left-arm");
  expect_term(terms[1], -1.0, "c", "reaction_torque", "z");
  EXPECT_EQ(terms[1].axes, "ground");
  expect_term(terms[2], -1.0, "d", "velocity", "y");
  EXPECT_EQ(terms[2].axes, "");
  expect_term(terms[3], 1.0, "left/elbow", "reaction_force", "x");
  EXPECT_EQ(terms[3].axes, "left/fore.arm");
  const SignalDescription formula = parse(
      "${(a/reaction_force/x@ground-b/reaction_force/x@left/arm)^2 / k + tool/velocity/z@arm*2}");
  ASSERT_EQ(formula.terms.size(), 3U);
  expect_term(formula.terms[0], 1.0, "a", "reaction_force", "x");
  EXPECT_EQ(formula.terms[0].axes, "ground");
  expect_term(formula.terms[1], 1.0, "b", "reaction_force", "x");
  EXPECT_EQ(formula.terms[1].axes, "left/arm");
  expect_term(formula.terms[2], 1.0, "tool", "velocity", "z");
  EXPECT_EQ(formula.terms[2].axes, "arm");
  EXPECT_EQ(formula.formula->names[2], "k");
}

TEST(Signal, RefusesWhatIsNoSignal) {
  for (const char* text :
       {"", "crank_joint", "crank_joint/", "/velocity", "a/velocity +", "a/velocity b/velocity",
        "a/velocity/", "a/velocity/x/y", "a/velocity - - b/velocity", "a/velocity * 2", "2", "a/9",
        "a/velocity/x@", "a/velocity/x@ b", "a/velocity/x@b c"}) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.file, "study.yaml");
      EXPECT_EQ(error.fault().where.line, 7);
      EXPECT_EQ(error.fault().element, "objective.integral[0].signal");
      EXPECT_EQ(error.fault().value, text);
      EXPECT_NE(error.fault().allowed.find("<joint>/<quantity>"), std::string::npos);
    }
  }
}

TEST(WatchedSignal, IsAnEqualityIfItsFinalBoundsAreEqual) {
  WatchedSignal watched;
  watched.lower = watched.upper = Quantity(1.0);
  EXPECT_FALSE(is_equality(watched)) << "a path";
  watched.role = WatchedSignal::Role::kFinal;
  EXPECT_TRUE(is_equality(watched));
  watched.upper = Quantity(1.5);
  EXPECT_FALSE(is_equality(watched));
  watched.upper.reset();
  EXPECT_FALSE(is_equality(watched));
}

TEST(WatchedSignal, HasOrderedBounds) {
  WatchedSignal watched;
  watched.upper = Quantity(1.0);
  EXPECT_NO_THROW(require_ordered_bounds(watched, {}));
  watched.lower = Quantity(1.0);
  EXPECT_THROW(require_ordered_bounds(watched, {}), InputError);
  watched.role = WatchedSignal::Role::kFinal;
  EXPECT_NO_THROW(require_ordered_bounds(watched, {}));
  watched.lower = Quantity(1.5);
  EXPECT_THROW(require_ordered_bounds(watched, {}), InputError);
}

TEST(Signal, AnExpressionReadsSignalsParametersAndTheTime) {
  const SignalDescription signal =
      parse("${max(crank/effort * crank/velocity, 0) / crank_length - left/elbow-2/position/x*t}");
  ASSERT_TRUE(signal.formula);
  EXPECT_EQ(signal.formula->names,
            (std::vector<std::string>{"crank/effort", "crank/velocity", "crank_length",
                                      "left/elbow-2/position/x", "t"}));
  ASSERT_EQ(signal.terms.size(), 3U);
  expect_term(signal.terms[0], 1.0, "crank", "effort", "");
  expect_term(signal.terms[2], 1.0, "left/elbow-2", "position", "x");
  // With spaces a slash divides.
  EXPECT_EQ(parse("${a / length}").formula->names, (std::vector<std::string>{"a", "length"}));
  EXPECT_FALSE(parse("a/velocity - b/velocity").formula);
}

TEST(Signal, AnExpressionReadsTheLossesOfGears) {
  const SignalDescription signal = parse("${pend/gear_loss * pend/velocity + pend/gear_torque}");
  ASSERT_EQ(signal.terms.size(), 3U);
  expect_term(signal.terms[0], 1.0, "pend", "gear_loss", "");
  expect_term(signal.terms[2], 1.0, "pend", "gear_torque", "");
  EXPECT_EQ(parse("left/elbow/gear_loss + left/elbow/gear_torque").terms.size(), 2U);
  EXPECT_EQ(parse("left/elbow/motor_position - left/elbow/gear_deflection").terms.size(), 2U);
}

TEST(Signal, AnExpressionThatIsNoneIsRefused) {
  for (const char* text :
       {"${crank/effort *}", "${}", "${sine(crank/effort)}", "${crank/effort > 1}"}) {
    try {
      parse(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().value, text);
      EXPECT_EQ(error.fault().where.line, 7);
    }
  }
}

}  // namespace

}  // namespace codesign
