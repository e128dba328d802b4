// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

TEST(StudyEnd, TheDurationIsAnExpression) {
  const Study study = read_text(
      "duration: \"${2*T + rod_length}\"\n"
      "parameters: {T: {initial: 1.0, lower: 0.5, upper: 3.0}}\n");
  EXPECT_TRUE(has_moving_end(study));
  EXPECT_DOUBLE_EQ(study.duration, 6.4);
  EXPECT_DOUBLE_EQ(duration_at(study, {0.08, 0.3, 1.0}), 2.3);
  EXPECT_EQ(study.used_parameters.count(2), 1U);
}

TEST(StudyEnd, AConditionEndsRuns) {
  const Study study = read_text(
      "duration: 2.0\nuntil: \"${crank_joint/position > 10*rod_length or not t < 1.5}\"\n");
  EXPECT_TRUE(has_moving_end(study));
  EXPECT_DOUBLE_EQ(duration_at(study, {0.08, 0.3}), 2.0);
  ASSERT_TRUE(study.until);
  ASSERT_EQ(study.until->terms.size(), 1U);
  EXPECT_EQ(study.until->terms[0].object, "crank_joint");
  EXPECT_EQ(study.used_parameters.count(1), 1U);
  EXPECT_EQ(study.until->where.line, 2);
}

// idas leaves such a run to rosenbrock, and the adjoint goes back over its end.
TEST(StudyEnd, AConditionTakesAnySolver) {
  for (const char* solver : {"integrator: idas", "gradient: adjoint"})
    EXPECT_NO_THROW(
        read_text("duration: 2.0\nuntil: \"${t > 1}\"\nsolver: {" + std::string(solver) + "}\n"))
        << solver;
}

TEST(StudyEnd, OtherStudiesHaveAFixedEnd) {
  const Study study = read_text("duration: 2.0\nfinal: [{signal: end_time, at_most: 3.0}]\n");
  EXPECT_FALSE(has_moving_end(study));
  EXPECT_EQ(study.watched[0].signal.text, "end_time");
}

}  // namespace
}  // namespace codesign
