// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/objective_part.h"

#include <gtest/gtest.h>

#include "description/motion_study.h"

namespace codesign {
namespace {

TEST(ObjectivePart, TermsAreNamedAsTheStudyWritesThem) {
  MotionStudy study;
  EXPECT_EQ(term_name(study, ObjectivePart::kIntegral, 0), "objective.integral[0]");
  EXPECT_EQ(term_name(study, ObjectivePart::kTerminal, 2), "objective.terminal[2]");
  study.postures = 5;
  EXPECT_EQ(term_name(study, ObjectivePart::kIntegral, 1), "objective.sum[1]");
  EXPECT_EQ(term_name(study, ObjectivePart::kTerminal, 1), "objective.terminal[1]");
}

}  // namespace
}  // namespace codesign
