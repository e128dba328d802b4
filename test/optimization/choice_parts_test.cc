// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/choice_parts.h"

#include <gtest/gtest.h>

#include "description/study.h"

namespace codesign {
namespace {

/// x of 0, 10, 20, 40, and y, z of three rows.
Study lists() {
  Study study;
  study.parameters = {
      {"x", 0.0, 0.0, 40.0, "", {}}, {"y", 0.0, 0.0, 1.0, "", {}}, {"z", 0.0, 5.0, 9.0, "", {}}};
  study.tuned = {0, 1, 2};
  study.choices = {{"x", {0}, {{0.0}, {10.0}, {20.0}, {40.0}}, {}, "", {}},
                   {"part", {1, 2}, {{0.0, 5.0}, {1.0, 6.0}, {0.5, 9.0}}, {}, "", {}}};
  return study;
}

TEST(ChoiceParts, TheNearestRowsAreNearestInEachColumn) {
  const Study study = lists();
  const ChoiceSpace space{study, choice_lists(study)};
  const ChoicePart all = all_rows(space);
  EXPECT_EQ(all, (ChoicePart{{0, 1, 2, 3}, {0, 1, 2}}));
  EXPECT_FALSE(is_single(all));
  const ChoicePart near = nearest_rows(space, all, Eigen::Vector3d(14.0, 0.9, 6.5));
  EXPECT_EQ(near, (ChoicePart{{1}, {1}}));
  EXPECT_TRUE(is_single(near));
}

TEST(ChoiceParts, TheListThatIsFarthestIsDividedBesideTheDesign) {
  const Study study = lists();
  const ChoiceSpace space{study, choice_lists(study)};
  const auto of_x = split_part(space, all_rows(space), Eigen::Vector3d(33.0, 1.0, 6.0));
  ASSERT_EQ(of_x.size(), 2u);
  EXPECT_EQ(of_x[0], (ChoicePart{{3}, {0, 1, 2}})) << "33 lies beyond the cut after 20";
  EXPECT_EQ(of_x[1], (ChoicePart{{0, 1, 2}, {0, 1, 2}}));
  const auto of_part = split_part(space, {{2}, {0, 1, 2}}, Eigen::Vector3d(20.0, 0.4, 5.0));
  EXPECT_EQ(of_part[0], (ChoicePart{{2}, {1, 2}})) << "0.4 lies beyond the cut after 0";
  EXPECT_EQ(of_part[1], (ChoicePart{{2}, {0}}));
}

TEST(ChoiceParts, AListIsTunedAsAWhole) {
  Study study = lists();
  study.tuned = {0, 1};
  EXPECT_THROW(choice_lists(study), InputError);
  study.tuned = {0};
  EXPECT_EQ(choice_lists(study).size(), 1u);
}

}  // namespace
}  // namespace codesign
