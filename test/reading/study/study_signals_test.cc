// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "description/tuned_parameters.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with_objective(const std::string& objective) {
  return "duration: 1\ncontrollers: {speed: {type: pid, input: crank_joint/velocity, setpoint: 0, "
         "output: crank_joint, gains: {p: 1}}}\n"
         "objective: " +
         objective + "\n";
}

TEST(StudyObjective, ReadsTerms) {
  const Study study = read_text(
      with_objective("{integral: [{signal: speed/output, weight: 0.01}], "
                     "terminal: [{signal: slider/position/x, reference: \"${rod_length}\"}]}"));
  ASSERT_EQ(study.integral.size(), 1U);
  EXPECT_EQ(study.integral[0].signal.terms.at(0).object, "speed");
  EXPECT_EQ(study.integral[0].weight.nominal(), 0.01);
  EXPECT_EQ(study.integral[0].reference.constant.nominal(), 0.0);
  ASSERT_EQ(study.terminal.size(), 1U);
  EXPECT_EQ(study.terminal[0].weight.nominal(), 1.0);
  EXPECT_EQ(study.terminal[0].reference.constant.nominal(), 0.3);
  EXPECT_FALSE(study.terminal[0].reference.constant.is_constant());
  EXPECT_EQ(study.terminal[0].where.line, 3);
}

TEST(StudyObjective, ReadsLosses) {
  const Study study = read_text(with_objective(
      "{integral: [{signal: speed/output}, {signal: speed/output, loss: square}, {signal: "
      "speed/output, loss: huber, scale: \"${2*rod_length}\"}], terminal: [{signal: "
      "speed/output, loss: above}]}"));
  ASSERT_EQ(study.integral.size(), 3U);
  EXPECT_EQ(study.integral[0].loss, LossKind::kSquare);
  EXPECT_EQ(study.integral[1].loss, LossKind::kSquare);
  EXPECT_EQ(study.integral[2].loss, LossKind::kHuber);
  EXPECT_EQ(study.integral[2].scale.nominal(), 0.6);
  EXPECT_EQ(study.terminal.at(0).loss, LossKind::kAbove);
}

TEST(StudyObjective, MayBeEmptyOrLeftOut) {
  for (const std::string& none :
       {with_objective("{}"), with_objective("{integral: [], terminal: []}"),
        std::string("duration: 1\n")}) {
    const Study study = read_text(none);
    EXPECT_TRUE(study.integral.empty() && study.terminal.empty());
  }
  expect_fault(with_objective("[]"), "objective", "expected a map", 3);
}

std::string with_watched_text(const std::string& lines) {
  return "duration: 2\ncontrollers: {speed: {type: pid, input: crank_joint/velocity, setpoint: 0, "
         "output: crank_joint, gains: {p: 1}}}\n" +
         lines + "\n";
}

TEST(StudyWatched, ReadsConstraintsAndPeaks) {
  const Study study = read_text(with_watched_text(
      "path: [{signal: speed/output, between: [-2, \"${10 * rod_length}\"], after: 0.1}]\n"
      "final: [{signal: slider/position/x, between: [0.3, 0.3]}, {signal: slider/velocity/x, "
      "at_most: 1}]\n"
      "objective: {peak: [{signal: crank_joint/velocity, reference: 1.0, weight: 3, before: "
      "1.5}]}"));
  ASSERT_EQ(study.watched.size(), 4U);
  const WatchedSignal& path = study.watched[0];
  EXPECT_EQ(path.role, WatchedSignal::Role::kPath);
  EXPECT_EQ(path.lower->nominal(), -2.0);
  EXPECT_FALSE(path.upper->is_constant());
  EXPECT_EQ(path.after, 0.1);
  EXPECT_EQ(path.before, 2.0);
  EXPECT_EQ(path.element, "path[0]");
  EXPECT_TRUE(is_equality(study.watched[1]));
  EXPECT_EQ(study.watched[1].after, 2.0);
  EXPECT_FALSE(study.watched[2].lower);
  EXPECT_FALSE(is_equality(study.watched[2]));
  EXPECT_EQ(study.watched[3].role, WatchedSignal::Role::kPeak);
  EXPECT_EQ(study.watched[3].weight, 3.0);
  EXPECT_EQ(study.watched[3].reference.constant.nominal(), 1.0);
  EXPECT_EQ(study.watched[3].before, 1.5);
  EXPECT_TRUE(has_objective(study));
}

TEST(StudyWatched, APeakWithinABoundIsABoundOnBothSides) {
  const Study study =
      read_text(with_watched_text("constraints: [rod_length >= 0.1, {peak: speed/output, at_most: "
                                  "\"${10*rod_length}\", reference: 0.5, after: 0.1},"
                                  " {peak: crank_joint/velocity, at_most: 4}]\nobjective: {peak: "
                                  "[{signal: crank_joint/velocity}]}\npath: [{signal: "
                                  "speed/output, at_most: 9}]"));
  ASSERT_EQ(study.watched.size(), 4U);
  EXPECT_EQ(study.constraints.size(), 1U);
  const WatchedSignal& peak = study.watched[1];
  EXPECT_EQ(peak.role, WatchedSignal::Role::kPath);
  EXPECT_EQ(peak.element, "constraints[1]");
  EXPECT_EQ(peak.signal.text, "speed/output");
  EXPECT_EQ(peak.reference.constant.nominal(), 0.5);
  EXPECT_EQ(peak.after, 0.1);
  EXPECT_EQ(peak.before, 2.0);
  const std::vector<double> design{0.08, 0.25};
  EXPECT_DOUBLE_EQ(peak.upper->at(design), 2.5);
  EXPECT_DOUBLE_EQ(peak.lower->at(design), -2.5);
  EXPECT_DOUBLE_EQ(peak.lower->expression()->derivative(1, design), -10.0);
  EXPECT_EQ(study.watched[2].lower->at(design), -4.0);
  EXPECT_EQ(study.watched[3].role, WatchedSignal::Role::kPeak);
}

TEST(StudyWatched, ReadsMeasures) {
  const Study study = read_text(with_watched_text(
      "constraints: [{stroke: speed/output, at_most: 2}, {maximum: speed/output, at_least: 1, "
      "after: 0.5}, \"rod_length >= 0.1\", {dwell: speed/output, band: [0, \"${rod_length}\"], "
      "between: [0.5, 1]}]\n"
      "objective: {arrival: [{signal: crank_joint/velocity, band: [-1, 1]}], minimum: [{signal: "
      "speed/output, weight: -2, reference: 1}]}"));
  ASSERT_EQ(study.watched.size(), 5U);
  using Measure = WatchedSignal::Measure;
  EXPECT_EQ(study.constraints.size(), 1U);
  EXPECT_EQ(study.watched[0].role, WatchedSignal::Role::kBounded);
  EXPECT_EQ(study.watched[0].measure, Measure::kStroke);
  EXPECT_EQ(study.watched[0].upper->nominal(), 2.0);
  EXPECT_FALSE(study.watched[0].lower);
  EXPECT_EQ(study.watched[1].element, "constraints[1]");
  EXPECT_EQ(study.watched[1].after, 0.5);
  EXPECT_EQ(study.watched[2].measure, Measure::kDwell);
  EXPECT_DOUBLE_EQ(study.watched[2].band_upper.at(std::vector<double>{0.08, 0.4}), 0.4);
  // In the order of kMeasureNames.
  EXPECT_EQ(study.watched[3].measure, Measure::kMinimum);
  EXPECT_EQ(study.watched[3].role, WatchedSignal::Role::kTerm);
  EXPECT_EQ(study.watched[3].weight, -2.0);
  EXPECT_EQ(study.watched[4].measure, Measure::kArrival);
  EXPECT_TRUE(has_objective(study));
}

}  // namespace
}  // namespace codesign
