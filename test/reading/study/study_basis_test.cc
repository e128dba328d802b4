// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

std::string push(const std::string& rest, const std::string& more = "") {
  return kLeastStudy + more + "controllers: {push: {type: basis, output: slider_joint, " + rest +
         "}}\n";
}

TEST(StudyBasis, ACountDeclaresThatManyParametersBehindAllOthers) {
  const Study study = read_text(
      push("shape: cubic, coefficients: {count: 5, initial: 0.5, lower: -1.0, upper: 2.0}",
           "parameters: {rod_length: {}}\n"));
  ASSERT_EQ(study.parameters.size(), 7U);
  EXPECT_EQ(study.parameters[2].name, "push_c0");
  EXPECT_EQ(study.parameters[6].name, "push_c4");
  EXPECT_EQ(study.parameters[6].value, 0.5);
  EXPECT_EQ(study.parameters[6].lower, -1.0);
  EXPECT_EQ(study.parameters[6].upper, 2.0);
  EXPECT_EQ(study.tuned, (std::vector<int>{1, 2, 3, 4, 5, 6}));
  const BasisDescription& basis = study.controllers.at(0).basis;
  EXPECT_EQ(basis.shape, BasisShape::kCubic);
  EXPECT_EQ(basis.duration, 2.0) << "the study's";
  EXPECT_EQ(basis.coefficients.at(3).at(std::vector<double>{1, 2, 3, 4, 5, 6, 7}), 6.0);
}

TEST(StudyBasis, StartsMayBeAListAndNoneOfThemTuned) {
  const Study study =
      read_text(push("coefficients: {count: 3, initial: [1, 2, 3], tune: false}, duration: 1.5"));
  EXPECT_EQ(study.parameters[4].value, 3.0);
  EXPECT_TRUE(study.tuned.empty());
  EXPECT_EQ(study.controllers.at(0).basis.duration, 1.5);
  EXPECT_EQ(study.controllers.at(0).basis.shape, BasisShape::kLinear);
}

TEST(StudyBasis, DeclaredCoefficientsAreParametersLikeOthers) {
  const Study study =
      read_text(push("coefficients: {count: 2}", "constraints: [\"push_c0 <= push_c1\"]\n"));
  EXPECT_EQ(study.constraints.size(), 1U);
}

TEST(StudyBasis, AListOfQuantitiesDeclaresNothing) {
  const Study study = read_text(push("coefficients: [0.0, \"${rod_length}\", 1.0]"));
  EXPECT_EQ(study.parameters.size(), 2U);
  EXPECT_EQ(study.controllers.at(0).basis.coefficients.at(1).nominal(), 0.3);
}

}  // namespace
}  // namespace codesign
