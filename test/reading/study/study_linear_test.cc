// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/linear_measure.h"
#include "description/study.h"
#include "problem/load_problem.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

const std::string kServos = cart_servo("gains: {p: 4, d: 1}, sample_time: 0.01") +
                            ", outer: {type: pid, input: x0/position, setpoint: 0, gains: {p: 1}}, "
                            "inner: {type: pid, input: x0/velocity - outer/output, setpoint: 0, "
                            "output: x0, gains: {p: 1}}";

std::vector<WatchedSignal> watched(const std::string& blocks,
                                   const std::string& controllers = kServos) {
  return study_of(loaded(carts(1, {""}), controlled(controllers) + blocks)).watched;
}

TEST(StudyLinear, ReadsBoundsAndTerms) {
  const std::vector<WatchedSignal> all = watched(
      "objective: {loop: [{loop: inner, measure: bandwidth, weight: -2}], poles: [{measure: "
      "growth}]}\nconstraints: [{poles: damping_ratio, at_least: 0.5, tolerance: 0.01}, {maximum: "
      "x0/position, at_most: 3}, {loop: servo0, measure: phase_margin, between: [0.5, 2]}]\n");
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0].linear, nullptr) << "signals come first";
  EXPECT_EQ(all[1].element, "constraints[0]");
  EXPECT_EQ(all[1].measure, WatchedSignal::Measure::kMinimum);
  EXPECT_EQ(all[1].linear->kind, LinearMeasure::Kind::kDampingRatio);
  EXPECT_EQ(*all[1].tolerance, 0.01);
  EXPECT_EQ(describe(all[1]), "poles, damping_ratio");
  EXPECT_EQ(describe(all[2]), "loop servo0, phase_margin");
  EXPECT_EQ(all[2].lower->nominal(), 0.5);
  EXPECT_EQ(all[3].weight, -2.0);
  EXPECT_EQ(all[3].linear->controller, "inner");
  EXPECT_EQ(all[4].element, "objective.poles[0]");
  EXPECT_TRUE(is_largest_of_many(all[4]));
}

TEST(StudyLinear, RefusesWhatIsNoLoop) {
  const auto message = [](const std::string& item, const std::string& controllers = kServos) {
    return refused([&] { watched("constraints: [" + item + "]\n", controllers); });
  };
  EXPECT_NE(message("{loop: sero0, measure: bandwidth, at_least: 1}").find("servo0"),
            std::string::npos);
  EXPECT_NE(message("{loop: outer, measure: bandwidth, at_least: 1}").find("drives no joint"),
            std::string::npos);
  EXPECT_NE(message("{loop: inner, measure: growth, at_least: 1}").find("gain_margin"),
            std::string::npos);
  EXPECT_NE(message("{poles: bandwidth, at_least: 1}").find("damping_ratio"), std::string::npos);
  EXPECT_NE(message("{poles: growth}").find("at_most"), std::string::npos);
  EXPECT_NE(message("{poles: radius, at_most: 1}", cart_servo("gains: {p: 4}"))
                .find("no controller of the study is sampled"),
            std::string::npos);
  EXPECT_NE(refused([&] {
              loaded(carts(1, {""}),
                     "positions: {x0: [0, 1]}\nconstraints: [{poles: growth, "
                     "at_most: 1}]\n");
            }).find("positions are many postures"),
            std::string::npos);
}

}  // namespace
}  // namespace codesign
