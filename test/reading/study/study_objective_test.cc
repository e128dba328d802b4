// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_objective.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string with_objective(const std::string& objective) {
  return "duration: 1\ncontrollers: {speed: {type: pid, input: crank_joint/velocity, setpoint: 0, output: crank_joint, gains: {p: 1}}}\n"
         "objective: " +
         objective + "\n";
}

TEST(StudyObjective, ReadsTerms) {
  const Study study =
      read_text(with_objective("{integral: [{signal: speed/output, weight: 0.01}], "
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

TEST(StudyObjective, MayBeEmptyOrLeftOut) {
  for (const std::string& none : {with_objective("{}"), with_objective("{integral: [], terminal: []}"), std::string("duration: 1\n")}) {
    const Study study = read_text(none);
    EXPECT_TRUE(study.integral.empty() && study.terminal.empty());
  }
  expect_fault(with_objective("[]"), "objective", "expected a map", 3);
}

TEST(StudyObjective, RefusesBadTerms) {
  expect_fault(with_objective("{integrl: []}"), "objective.integrl", "did you mean \"integral\"", 3);
  expect_fault(with_objective("{integral: {signal: speed/output}}"), "objective.integral", "expected a list", 3);
  expect_fault(with_objective("{integral: [{weight: 1}]}"), "objective.integral[0].signal", "required key is missing", 3);
  expect_fault(with_objective("{integral: [{signal: speed/output}, {signal: speed/ouput}]}"), "objective.integral[1].signal", "\"output\"",
               3);
  expect_fault(with_objective("{integral: [{signal: sped/output}]}"), "objective.integral[0].signal", "did you mean \"speed\"", 3);
  expect_fault(with_objective("{integral: [{signal: crank_joint/friction}]}"), "objective.integral[0].signal", "unknown quantity", 3);
  expect_fault(with_objective("{terminal: [{signal: slider/position}]}"), "objective.terminal[0].signal", "needs the component", 3);
  expect_fault(with_objective("{terminal: [{signal: speed/output, wieght: 1}]}"), "objective.terminal[0].wieght", "did you mean \"weight\"",
               3);
  expect_fault(with_objective("{terminal: [{signal: speed/output, weight: heavy}]}"), "objective.terminal[0].weight", "not a number", 3);
  expect_fault(with_objective("{terminal: [{signal: speed/output, reference: .nan}]}"), "objective.terminal[0].reference", "not finite", 3);
}

}  // namespace
}  // namespace codesign
