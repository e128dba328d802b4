// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <cmath>

#include "description/study.h"
#include "forces/pade.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

Study with_controllers(const std::string& controllers) {
  return read_text(kLeastStudy + "parameters: {f: {initial: 20.0}}\ncontrollers:\n  " +
                   controllers + "\n");
}

TEST(StudyFilters, OneOrAList) {
  const std::string pid =
      "speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: crank_joint, gains: "
      "{p: 1}, filter: ";
  const Study one = with_controllers(pid + "{type: low_pass_2, frequency: \"${f}\"}}");
  const std::vector<FilterDescription>& filters = one.controllers.at(0).filters;
  ASSERT_EQ(filters.size(), 1U);
  EXPECT_EQ(filters[0].kind, FilterKind::kLowPass2);
  EXPECT_EQ(filters[0].numbers.at(0).nominal(), 20.0);
  EXPECT_FALSE(filters[0].numbers.at(0).is_constant());
  EXPECT_NEAR(filters[0].numbers.at(1).nominal(), std::sqrt(0.5), 1e-15) << "the default";
  const Study list = with_controllers(
      pid + "[{type: notch, frequency: 30, damping: 0.4}, {type: lead_lag, zero: 2, pole: 9}]}");
  const std::vector<FilterDescription>& two = list.controllers.at(0).filters;
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].kind, FilterKind::kNotch);
  EXPECT_EQ(two[0].numbers.at(2).nominal(), 0.0);
  EXPECT_EQ(two[1].kind, FilterKind::kLeadLag);
  EXPECT_EQ(two[1].numbers.at(1).nominal(), 9.0);
}

TEST(StudyFilters, PadesApproximationIsAListOfAllPasses) {
  const std::string pid =
      "speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: crank_joint, gains: "
      "{p: 1}, filter: {type: pade, delay: \"${f}\", order: ";
  const std::vector<FilterDescription> filters =
      with_controllers(pid + "3}}").controllers.at(0).filters;
  ASSERT_EQ(filters.size(), 2U) << "a pair and a pole";
  for (const FilterDescription& filter : filters) {
    EXPECT_TRUE(is_pade(filter.kind));
    EXPECT_FALSE(filter.numbers.at(0).is_constant());
  }
  EXPECT_THROW(with_controllers(pid + "0}}"), InputError);
  EXPECT_THROW(with_controllers(pid + "11}}"), InputError);
  EXPECT_THROW(with_controllers(pid + "2}, sample_time: 0.01}"), InputError)
      << "its delay is exact";
}

TEST(StudyFilters, OfTheSignalsOfStateFeedback) {
  const Study study = with_controllers(
      "hold: {type: state_feedback, output: crank_joint, feedback: [{signal: "
      "crank_joint/position, gain: 3}, {signal: crank_joint/velocity, gain: 1, filter: {type: "
      "low_pass, frequency: 8}}]}");
  const std::vector<FeedbackTerm>& feedback = study.controllers.at(0).feedback;
  EXPECT_TRUE(feedback.at(0).filters.empty());
  EXPECT_EQ(feedback.at(1).filters.at(0).numbers.at(0).nominal(), 8.0);
}

}  // namespace
}  // namespace codesign
