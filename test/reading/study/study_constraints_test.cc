// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_constraints.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

double margin(const Study& study, std::size_t k, double crank, double rod) {
  return study.constraints.at(k).margin->value(std::vector<double>{crank, rod});
}

TEST(StudyConstraints, MayUseTheStudysOwnParameters) {
  const Study study = read_text(kLeastStudy + "parameters: {Kp: {initial: 1}}\nconstraints: [\"Kp >= 10*rod_length\"]\n");
  EXPECT_DOUBLE_EQ(study.constraints.at(0).margin->value(std::vector<double>{0.08, 0.3, 5.0}), 2.0);
  EXPECT_EQ(study.constraints[0].where.line, 4);
}

TEST(StudyConstraints, BoundSumsOfParameters) {
  const Study study = read_text(kLeastStudy +
                                "constraints:\n"
                                "  - \"rod_length - crank_length >= 0.165\"\n"
                                "  - {expression: \"${crank_length + rod_length}\", between: [0.3, \"${5*crank_length}\"]}\n"
                                "  - {expression: \"${2*rod_length}\", at_most: 0.7}\n");
  ASSERT_EQ(study.constraints.size(), 4U);
  EXPECT_EQ(study.constraints[1].text, "crank_length + rod_length >= 0.3");
  EXPECT_EQ(study.constraints[2].text, "crank_length + rod_length <= 5*crank_length");
  EXPECT_EQ(study.constraints[3].text, "2*rod_length <= 0.7");
  EXPECT_EQ(study.constraints[2].element, "constraints[1]");
  EXPECT_EQ(study.constraints[3].element, "constraints[2]");
  EXPECT_EQ(study.constraints[3].where.line, 6);
  EXPECT_NEAR(margin(study, 1, 0.1, 0.25), 0.05, 1e-15);
  EXPECT_NEAR(margin(study, 2, 0.1, 0.25), 0.15, 1e-15);
  EXPECT_NEAR(margin(study, 3, 0.1, 0.25), 0.2, 1e-15);
  EXPECT_EQ(study.used_parameters.count(0), 0U) << "a constraint moves nothing";
}

TEST(StudyConstraints, AreChecked) {
  expect_fault(kLeastStudy + "constraints:\n  - rod_length >= 0.1\n  - Kp >= 1\n", "constraints[1]", "Kp", 5);
  expect_fault(kLeastStudy + "constraints: rod_length >= 0.1\n", "constraints", "expected a list", 3);
  const auto refuse = [](const std::string& item, const std::string& element, const std::string& message) {
    expect_fault(kLeastStudy + "constraints: [" + item + "]\n", element, message, 3);
  };
  refuse("{expresion: \"${rod_length}\", at_most: 1}", "constraints[0]", "not a constraint");
  refuse("[rod_length]", "constraints[0]", "not a constraint");
  refuse("{expression: \"${rod_lenght}\", at_most: 1}", "constraints[0].expression", "did you mean 'rod_length'");
  refuse("{expression: 3, at_most: 1}", "constraints[0].expression", "no parameter appears");
  refuse("{expression: \"${rod_length}\"}", "constraints[0]", "needs bounds");
  refuse("{expression: \"${rod_length}\", after: 1, at_most: 1}", "constraints[0].after", "unknown key");
  refuse("{expression: \"${rod_length}\", between: [0.3, 0.3]}", "constraints[0]", "the lower bound, 0.3, must be less than the upper one");
  refuse("{expression: \"${rod_length}\", between: [0.5, 0.4]}", "constraints[0]", "must be less than");
}

}  // namespace
}  // namespace codesign
