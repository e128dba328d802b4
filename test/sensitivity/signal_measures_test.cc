// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Stroke, maximum, minimum, arrival and dwell of whole runs.
#include <gtest/gtest.h>

#include <cmath>

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "integration/watch_layout.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"
#include "sensitivity/oscillator.h"
#include "sensitivity/watched_cases.h"

namespace codesign {
namespace {

/// The objective's only term, with its derivatives by k and the amplitude.
Evaluation term(const std::string& measure, const std::string& keys, const std::string& duration,
                const std::string& signal = "slide/position") {
  const Problem problem = oscillator("duration: " + duration + "\nobjective: {" + measure +
                                     ": [{signal: " + signal + keys + "}]}\n");
  return Evaluator(problem).evaluate(problem.start(), true);
}

void expect_term(const Evaluation& evaluation, double value, double by_k, double by_amplitude) {
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_NEAR(evaluation.objective, value, 1e-9);
  EXPECT_NEAR(evaluation.gradient[0], by_k, 1e-8);
  EXPECT_NEAR(evaluation.gradient[1], by_amplitude, 1e-8);
}

constexpr double kPi = 3.141592653589793;

TEST(SignalMeasures, RangesOfAnOscillation) {
  expect_term(term("stroke", "", "5"), 2.0, 0.0, 2.0);
  expect_term(term("maximum", ", weight: -3, after: 1", "5"), -3.0, 0.0, -3.0);
  expect_term(term("minimum", ", reference: 0.25", "5"), -1.25, 0.0, -1.0);
  // Until cos(2 t) = cos 1 only: no extremum inside.
  expect_term(term("stroke", "", "0.5"), 1.0 - std::cos(1.0), std::sin(1.0) * 0.5 / 4.0,
              1.0 - std::cos(1.0));
}

// x = a cos(w t) passes e at acos(e/a)/w.
TEST(SignalMeasures, TimesOfAnOscillation) {
  const double w = 2.0, at = std::acos(0.5) / w, by_a = 0.5 / std::sqrt(0.75) / w;
  expect_term(term("arrival", ", band: [-0.5, 0.5]", "0.69"), at, -at / 8.0, by_a);
  const double dwell = kPi / w - 2.0 * at;
  expect_term(term("dwell", ", band: [-0.5, 0.5]", "1.5707963"), dwell, -dwell / 8.0, -2.0 * by_a);
  // A period: two stays.
  expect_term(term("dwell", ", band: [-0.5, 0.5], weight: -2", "3.14"), -4.0 * dwell, dwell / 2.0,
              8.0 * by_a);
  // The edges move with the amplitude.
  expect_term(term("arrival", ", band: [-1, \"${amplitude/2}\"]", "0.69"), at, -at / 8.0, 0.0);
}

// x^2 = a^2 cos(w t)^2 and x v = -a^2 w/2 sin(2 w t).
TEST(SignalMeasures, OfExpressions) {
  const std::string square = "\"${slide/position^2}\"",
                    product = "\"${slide/position*slide/velocity}\"";
  const double w = 2.0, at = std::acos(0.5) / w, by_a = 0.5 / std::sqrt(0.75) / w;
  expect_term(term("stroke", "", "5", square), 1.0, 0.0, 2.0);
  expect_term(term("stroke", "", "5", product), w, 0.25, 2.0 * w);
  expect_term(term("maximum", ", weight: 2", "5", product), w, 0.25, 2.0 * w);
  expect_term(term("minimum", ", reference: \"${amplitude}\"", "5", product), -2.0, -0.125, -3.0);
  expect_term(term("peak", ", after: 1.6, before: 3", "5", product), 1.0, 0.125, 2.0);
  expect_term(term("arrival", ", band: [-1, 0.25]", "0.69", square), at, -at / 8.0, by_a);
  const double dwell = kPi / w - 2.0 * at;
  expect_term(term("dwell", ", band: [-1, 0.25]", "1.5707963", square), dwell, -dwell / 8.0,
              -2.0 * by_a);
}

TEST(SignalMeasures, TimesThatAreMissed) {
  const double end = std::cos(1.0), by_k = -std::sin(1.0) * 0.5 / 4.0;
  expect_term(term("arrival", ", band: [-0.1, 0.4]", "0.5"), 0.5 + (end - 0.4), by_k, end);
  expect_term(term("dwell", ", band: [1.5, 2.0]", "5"), -5.0 * 0.5 / 0.5, 0.0, 10.0);
}

// Along a motion with friction and loops, against differences of runs with tight tolerances, for
// the two lengths that count most.
TEST(SignalMeasures, GradientsMeetDifferences) {
  GradientCase test = gradient_cases().front();
  test.study.tuned.resize(2);
  test.study.integral.clear();
  test.study.terminal.clear();
  test.study.solver.relative_tolerance = 1e-13;
  test.study.solver.absolute_tolerance = 1e-14;
  const std::string joint = "crank_joint";
  const auto add = [&](WatchedSignal::Measure measure, const std::string& text, double weight) {
    WatchedSignal& watched = test.study.watched.emplace_back();
    watched.role = WatchedSignal::Role::kTerm;
    watched.measure = measure;
    watched.signal = parse_signal(text, {}, "signal");
    watched.weight = weight;
    watched.before = test.study.duration;
    return &watched;
  };
  add(WatchedSignal::Measure::kStroke, "slider_joint/position", 1.0);
  add(WatchedSignal::Measure::kMaximum, joint + "/velocity", 0.1);
  const auto system = test.compile("rodas5p", "auto");
  const Evaluation run = evaluator_of(system).evaluate(start_of(test.study), false);
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  // A band around the middle of the slider's motion.
  const WatchLayout layout(system->study());
  const Eigen::VectorXd values = run.extremes.values.segment(0, layout.entries()[0].measure());
  const double low = values.minCoeff(), high = values.maxCoeff(), width = high - low;
  for (WatchedSignal::Measure measure :
       {WatchedSignal::Measure::kDwell, WatchedSignal::Measure::kArrival}) {
    WatchedSignal* band = add(measure, "slider_joint/position", 0.3);
    band->band_lower = Quantity(low + 0.3 * width);
    band->band_upper = Quantity(low + 0.8 * width);
  }
  const GradientCheck check = check_gradient(test.compile("rodas5p", "auto"), start_of(test.study),
                                             CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_EQ(check.method, CheckMethod::kRidders);
  EXPECT_LT(check.largest_relative_difference, 1e-8);
}

TEST(SignalMeasures, RangesMeetTheComplexStep) {
  for (const char* lines :
       {"objective: {stroke: [{signal: slide/velocity}], minimum: [{signal: slide/acceleration, "
        "weight: -1}]}\nconstraints: [{maximum: slide/position, at_least: 1}]\n",
        "objective: {stroke: [{signal: \"${slide/velocity*abs(slide/position - 2)}\"}], peak: "
        "[{signal: "
        "\"${slide/acceleration*slide/position + t}\"}]}\nconstraints: [{maximum: "
        "\"${exp(slide/position)}\", at_least: 1}]\npath: [{signal: "
        "\"${slide/position^3 - k*t}\", at_most: 9}]\nfinal: [{signal: "
        "\"${slide/position*slide/velocity}\", at_most: 9}]\n"}) {
    const Problem problem = oscillator("duration: 3\n" + std::string(lines));
    const GradientCheck check = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_EQ(check.method, CheckMethod::kComplexStep);
    EXPECT_GT(check.extreme_reference.cwiseAbs().rowwise().maxCoeff().minCoeff(), 0.0) << lines;
    EXPECT_LT(check.largest_relative_difference, 1e-10) << lines;
  }
}

}  // namespace
}  // namespace codesign
