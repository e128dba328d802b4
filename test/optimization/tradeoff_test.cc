// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/tradeoff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "optimization/cart.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const std::string kHold = R"(
initial_state: {slide: {position: 1.0, velocity: 0.0}}
controllers:
  hold: {type: state_feedback, output: slide, feedback: [{signal: slide/position, gain: "${k1}"}, {signal: slide/velocity, gain: "${k2}"}]}
parameters: {k1: {initial: 1.0, lower: 0.2, upper: 5.0}, k2: {initial: 1.0, lower: 0.3, upper: 8.0}}
)";

const std::string kRegulator = R"yaml(
duration: 60.0
constraints: ["k2 <= 1.5*sqrt(k1)"]
tradeoff:
  - {name: error, objective: {integral: [{signal: slide/position}]}}
  - {name: effort, objective: {integral: [{signal: hold/output}]}}
solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-11}
optimizer: {relative_tolerance: 1.0e-13}
)yaml" + kHold;

Problem cart(const std::string& study) {
  return load_problem(cart_urdf(), {}, {"cart.yaml", study});
}

bool is_inside(double value, double lower, double upper) {
  return value > lower + 1e-6 && value < upper - 1e-6;
}

/// min of error + r effort is the state feedback k1 = r^-1/2, k2 = sqrt(2) r^-1/4 for each r, and
/// from x = 1 the double integrator has error = (k1 + k2^2)/(2 k1 k2), effort = k1^2/(2 k2).
TEST(Tradeoff, TheDoubleIntegratorHasTheCurveOfItsRegulators) {
  const TradeoffResult result = find_tradeoff(cart(kRegulator), 26, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.points.size(), 26u);
  int regulators = 0;
  for (const TradeoffPoint& point : result.points) {
    const double k1 = point.rho[0], k2 = point.rho[1];
    EXPECT_EQ(point.kind, TradeoffKind::kOnCurve) << k1 << ", " << k2;
    EXPECT_NEAR(point.objectives[0], (k1 + k2 * k2) / (2.0 * k1 * k2), 1e-7);
    EXPECT_NEAR(point.objectives[1], k1 * k1 / (2.0 * k2), 1e-7 * k1 * k1);
    if (!is_inside(k1, 0.2, 5.0)) continue;
    ++regulators;
    EXPECT_NEAR(k2, std::sqrt(2.0 * k1), 1e-5);  // of the same r
  }
  EXPECT_GE(regulators, 20);
  // Parts of the curve are halved until they are about equal.
  EXPECT_LT(result.largest_gap, 2.5 * result.smallest_gap);
  EXPECT_LT(result.largest_gap, 2.0 * std::sqrt(2.0) / 25.0);
}

TEST(Tradeoff, EachPointIsBetterInOneObjectiveThanItsNeighbour) {
  const TradeoffResult result = find_tradeoff(cart(kRegulator), 7, {}, nullptr);
  ASSERT_EQ(result.points.size(), 7u);
  for (std::size_t k = 1; k < result.points.size(); ++k) {
    EXPECT_GT(result.points[k].objectives[0], result.points[k - 1].objectives[0]);
    EXPECT_LT(result.points[k].objectives[1], result.points[k - 1].objectives[1]);
  }
  EXPECT_TRUE(result.points.front().is_anchor);
  EXPECT_TRUE(result.points.back().is_anchor);
  // The ends give a ten thousandth of their own objective for the others.
  EXPECT_NEAR(result.ideal[0], result.points.front().objectives[0],
              1.1e-4 * (result.nadir[0] - result.ideal[0]));
  EXPECT_EQ(result.nadir[0], result.points.back().objectives[0]);
}

/// Terms that are the largest of many values have slack variables, in the unit of each objective.
TEST(Tradeoff, PeaksAreObjectivesToo) {
  const TradeoffResult result = find_tradeoff(cart(R"(
duration: 8.0
tradeoff:
  - {name: error, objective: {integral: [{signal: slide/position}]}}
  - {name: push, objective: {peak: [{signal: hold/output, weight: 3.0}]}}
optimizer: {relative_tolerance: 1.0e-9}
)" + kHold),
                                              5, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  for (const TradeoffPoint& point : result.points) {
    if (point.kind == TradeoffKind::kFailed) ADD_FAILURE() << point.status.cause;
    // The effort is largest where it begins: k1.
    if (point.rho[1] * point.rho[1] > 4.0 * 0.2) {
      EXPECT_GE(point.objectives[1], 3.0 * point.rho[0] - 1e-6);
    }
  }
  EXPECT_NEAR(result.points.front().objectives[1], result.nadir[1], 1e-9);
}

/// The objectives are quadratic in the start: runs from 1 and 2 with the weights 3 and 1 have the
/// mean 7/4 of those from 1, and the worst 4 times as much, at the same designs.
TEST(Tradeoff, OfRunsTheMeanOrTheWorstCounts) {
  const std::string runs =
      "runs: {near: {weight: 3.0}, far: {initial_state: {slide: {position: 2.0}}}}\n";
  const TradeoffResult one = find_tradeoff(cart(kRegulator), 5, {}, nullptr),
                       mean = find_tradeoff(cart(kRegulator + runs), 5, {}, nullptr),
                       worst = find_tradeoff(cart(kRegulator + runs + "robust: {measure: worst}\n"),
                                             5, {}, nullptr);
  ASSERT_EQ(mean.points.size(), 5u);
  ASSERT_EQ(worst.points.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_TRUE(one.points[k].objectives.isApprox(mean.points[k].objectives / 1.75, 1e-5)) << k;
    EXPECT_TRUE(one.points[k].objectives.isApprox(worst.points[k].objectives / 4.0, 1e-5)) << k;
    EXPECT_TRUE(one.points[k].rho.isApprox(mean.points[k].rho, 1e-4)) << k;
  }
}

/// The squares of the distances from three places: the best designs are the triangle between them.
TEST(Tradeoff, ThreeObjectivesFillATriangle) {
  const auto from = [](const std::string& name, const std::string& x, const std::string& y) {
    return "  - {name: " + name +
           ", objective: {terminal: [{signal: slide/position, reference: \"${k1 - " + x +
           "}\"}, {signal: slide/position, reference: \"${k2 - " + y + "}\"}]}}\n";
  };
  const TradeoffResult result = find_tradeoff(
      cart(
          "duration: 0.1\nparameters: {k1: {initial: 3.0, lower: -5.0, upper: 5.0}, k2: {initial: "
          "-2.0, lower: -5.0, upper: 5.0}}\noptimizer: {relative_tolerance: 1.0e-10}\ntradeoff:\n" +
          from("a", "0", "0") + from("b", "1", "0") + from("c", "0", "1")),
      4, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.points.size(), 10u);
  for (const TradeoffPoint& point : result.points) {
    EXPECT_EQ(point.kind, TradeoffKind::kOnCurve);
    EXPECT_GT(point.rho.minCoeff(), -1e-4);
    EXPECT_LT(point.rho.sum(), 1.0 + 1e-4);
  }
  double nearest = 1.0;
  for (std::size_t k = 0; k < 10; ++k)
    for (std::size_t other = 0; other < k; ++other)
      nearest = std::min(nearest, (result.points[k].rho - result.points[other].rho).norm());
  EXPECT_GT(nearest, 0.1) << "of 1/3 if they were equal";
  EXPECT_TRUE(std::isnan(result.largest_gap)) << "no neighbours along a curve";
}

TEST(Tradeoff, ACancelledJobKeepsItsPoints) {
  int told = 0;
  const TradeoffResult result = find_tradeoff(
      cart(kRegulator), 9,
      [&](const TradeoffPoint&, int done, int of) {
        EXPECT_EQ(done, ++told);
        EXPECT_EQ(of, 9);
        return done < 4;
      },
      nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.points.size(), 4u);
  const std::atomic<bool> cancel{true};
  const TradeoffResult none = find_tradeoff(cart(kRegulator), 9, {}, &cancel);
  EXPECT_EQ(none.status.code, StatusCode::kCancelled);
  EXPECT_TRUE(none.points.empty());
}

TEST(Tradeoff, ObjectivesThatAgreeHaveNothingToTrade) {
  const TradeoffResult result = find_tradeoff(cart(R"(
duration: 8.0
tradeoff:
  - {name: one, objective: {integral: [{signal: slide/position}]}}
  - {name: two, objective: {integral: [{signal: slide/position, weight: 2.0}]}}
)" + kHold),
                                              5, {}, nullptr);
  EXPECT_TRUE(result.status.ok());
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "no_tradeoff");
}

TEST(Tradeoff, AnEndThatCannotBeFoundEndsTheJob) {
  const TradeoffResult result = find_tradeoff(
      cart(kRegulator + "path: [{signal: slide/position, at_most: 0.5}]\n"), 5, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible);
  ASSERT_EQ(result.points.size(), 1u);
  EXPECT_EQ(result.points[0].kind, TradeoffKind::kFailed);
}

TEST(Tradeoff, RefusesWhatItCannotDo) {
  EXPECT_THROW(find_tradeoff(cart("duration: 1.0\nobjective: {terminal: [{signal: "
                                  "slide/position}]}\n" +
                                  kHold),
                             5, {}, nullptr),
               InputError);
  for (const int points : {-1, 1, 2, 1001})
    EXPECT_THROW(find_tradeoff(cart(kRegulator), points, {}, nullptr), InputError) << points;
  EXPECT_THROW(
      find_tradeoff(
          cart(kRegulator +
               "runs: {a: {}, b: {weight: 2.0}}\nrobust: {measure: mean_plus_deviation}\n"),
          5, {}, nullptr),
      InputError);
}

TradeoffPoint at(double first, double second, TradeoffKind kind = TradeoffKind::kOnCurve) {
  TradeoffPoint point;
  point.objectives = Eigen::Vector2d(first, second);
  point.kind = kind;
  return point;
}

TEST(Tradeoff, PointsAreSortedOut) {
  std::vector<TradeoffPoint> points{at(0, 1),
                                    at(0.5, 0.5),
                                    at(0.6, 0.5),
                                    at(0.5, 0.5 + 1e-9),
                                    at(0.55, 0.4, TradeoffKind::kStoppedEarly),
                                    at(0.1, 0.1, TradeoffKind::kFailed),
                                    at(1, 0)};
  sort_out(Eigen::Vector2d::Ones(), &points);
  const std::vector<TradeoffKind> expected{TradeoffKind::kOnCurve,      TradeoffKind::kOnCurve,
                                           TradeoffKind::kDominated,    TradeoffKind::kRepeated,
                                           TradeoffKind::kStoppedEarly, TradeoffKind::kFailed,
                                           TradeoffKind::kOnCurve};
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(points[k].kind, expected[k]) << k;
}

}  // namespace
}  // namespace codesign
