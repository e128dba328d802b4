// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
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

TEST(FrictionNumbers, EveryMemberIsVisitedOnceInEachForm) {
  FrictionNumbers<double> numbers;
  std::set<const double*> in_any_form;
  for (const bool direct : {false, true}) {
    std::set<const double*> visited;
    std::set<std::string> names;
    const auto note = [&](const FrictionNumberRule& rule, double& number) {
      if (!rule.is_in(direct)) return;
      EXPECT_TRUE(visited.insert(&number).second) << rule.attribute;
      names.insert(rule.attribute);
    };
    visit_friction_numbers(note, &numbers);
    EXPECT_EQ(names.size(), visited.size());
    in_any_form.insert(visited.begin(), visited.end());
  }
  EXPECT_EQ(in_any_form.size(), sizeof(numbers) / sizeof(double));
}

TEST(FrictionNumbers, TwoStructuresAreVisitedSideBySide) {
  FrictionNumbers<double> from;
  FrictionNumbers<float> to;
  from.preload = 3.0;
  visit_friction_numbers(
      [](const FrictionNumberRule&, const double& a, float& b) { b = static_cast<float>(a); },
      &from, &to);
  EXPECT_EQ(to.preload, 3.0F);
}

TEST(FrictionNumbers, ModelsUseTheirOwn) {
  std::set<std::string> of_lugre, of_gonthier;
  const auto note = [&](const FrictionNumberRule& rule, const Quantity&) {
    if (FrictionModel::kLuGre->uses(rule)) of_lugre.insert(rule.attribute);
    if (FrictionModel::kGonthier->uses(rule)) of_gonthier.insert(rule.attribute);
    EXPECT_EQ(FrictionModel::kBrownMcPhee->uses(rule),
              rule.laws == FrictionNumberRule::Laws::kAll ||
                  rule.laws == FrictionNumberRule::Laws::kDirectional);
  };
  const FrictionDescription friction;
  visit_friction_numbers(note, &friction);
  EXPECT_EQ(of_gonthier.size(), of_lugre.size() + 1);
  EXPECT_EQ(of_lugre.count("dwell_time"), 0U);
  EXPECT_EQ(of_lugre.count("mu_static_backward"), 0U);
  EXPECT_EQ(of_lugre.count("viscous_backward"), 1U);
  EXPECT_EQ(friction.dwell_time.nominal(), 2.0);
}

TEST(JointDescription, TheElementTellsLoopsFromJoints) {
  JointDescription joint;
  joint.name = "pin";
  EXPECT_EQ(joint.element(), "<joint name=\"pin\">");
  joint.is_loop = true;
  EXPECT_EQ(joint.element(), "<loop name=\"pin\">");
}

TEST(JointType, OneCoordinate) {
  for (const RowReference<JointLaw>& joint : standard_laws().joints) {
    const bool turn = joint->type == JointType::kRevolute || joint->type == JointType::kContinuous;
    EXPECT_EQ(joint->is_turn(), turn) << static_cast<int>(joint->type);
    EXPECT_EQ(joint->has_one_coordinate(), turn || joint->type == JointType::kPrismatic)
        << static_cast<int>(joint->type);
  }
}

TEST(LimitDescription, ZerosAreNoLimits) {
  LimitDescription limit;
  EXPECT_FALSE(limit.bounds_position() || limit.bounds_effort() || limit.bounds_velocity());
  limit.lower = -1.0;
  EXPECT_TRUE(limit.bounds_position());
  limit.effort =
      Quantity(0.0, std::make_shared<const Expression>("x", std::vector<std::string>{"x"}));
  EXPECT_TRUE(limit.bounds_effort()) << "an expression";
  EXPECT_FALSE(limit.bounds_velocity());
}

}  // namespace

}  // namespace codesign
