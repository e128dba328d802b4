// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/laws.h"

#include <gtest/gtest.h>

#include <set>

#include "description/robot.h"

namespace codesign {
namespace {

TEST(Laws, EveryJointTypeMakesThePairOfItsRow) {
  std::set<JointType> types;
  for (const RowReference<JointLaw>& row : standard_laws().joints) {
    if (row->type == JointType::kOther) continue;
    EXPECT_TRUE(types.insert(row->type).second) << "each type has one row";
    JointDescription joint;
    joint.type = row->type;
    EXPECT_EQ(kind_of(joint), pair_of(*row)) << static_cast<int>(row->type);
  }
  EXPECT_EQ(types.size(), static_cast<std::size_t>(JointType::kOther));
}

TEST(Laws, FrictionHasAFunctionForEitherScalar) {
  for (const FrictionModel& law : standard_laws().friction) {
    EXPECT_NE(static_cast<bool>(law->curve), static_cast<bool>(law->bristle)) << law->name;
    EXPECT_EQ(law->curve.computed == nullptr, law->curve.recorded == nullptr) << law->name;
    EXPECT_EQ(find_friction(standard_laws(), law->name), law);
  }
  EXPECT_FALSE(find_friction(standard_laws(), "sticky"));
}

}  // namespace
}  // namespace codesign
