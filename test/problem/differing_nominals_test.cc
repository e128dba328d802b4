// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "problem/differing_nominals.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Study study_with(double nominal, double found) {
  Study study;
  study.parameters = {{"mu", nominal, 0.0, 1.0, "", {}}};
  UncertainQuantity quantity{"mu", 0, {DistributionKind::kNormal, found, 0.01, 0.0, 1.0, {}}, {}, {"study.yaml", 7}};
  quantity.is_identified = true;
  quantity.spread = 0.02;
  study.ensemble.uncertain = {quantity};
  return study;
}

TEST(DifferingNominals, WarnsOfAModelWithoutTheIdentifiedValues) {
  const Warnings warnings = differing_nominals(study_with(0.3, 0.25));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "nominal_differs");
  EXPECT_EQ(warnings[0].where.line, 7);
  for (const char* part : {"mu 0.3", "0.25", "identified_overlay.urdf"})
    EXPECT_NE(warnings[0].message.find(part), std::string::npos) << warnings[0].message;
}

TEST(DifferingNominals, SaysNothingOfEqualValuesAndOfGuesses) {
  EXPECT_TRUE(differing_nominals(study_with(0.25, 0.25)).empty());
  EXPECT_TRUE(differing_nominals(study_with(0.25, 0.25 + 1e-9)).empty());
  Study guessed = study_with(0.3, 0.25);
  guessed.ensemble.uncertain[0].is_identified = false;
  EXPECT_TRUE(differing_nominals(guessed).empty());
}

}  // namespace
}  // namespace codesign
