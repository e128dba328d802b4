// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/loss_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "codegen/traced.h"

namespace codesign {
namespace {

double loss_at(const LossKind& kind, double r, double c = 1.0) {
  return weighted_loss(*kind, 1.0, LossValues<double>{r, 0.0, c});
}

/// The loss without kinks at this residual, as one sees it from there.
double slope_at(const LossKind& kind, double r, double c) {
  const double h = 1e-6;
  return (loss_at(kind, r + h, c) - loss_at(kind, r - h, c)) / (2.0 * h);
}

TEST(LossLaw, ASquare) {
  EXPECT_EQ(loss_at(LossKind::kSquare, 0.0), 0.0);
  EXPECT_EQ(loss_at(LossKind::kSquare, -3.0), 9.0);
  EXPECT_EQ(weighted_loss(*LossKind::kSquare, 0.1, LossValues<double>{0.7, 0.4}),
            0.1 * (0.7 - 0.4) * (0.7 - 0.4))
      << "from the left, as before there were losses";
}

TEST(LossLaw, AMagnitude) {
  EXPECT_EQ(loss_at(LossKind::kAbsolute, 0.0), 0.0);
  EXPECT_EQ(loss_at(LossKind::kAbsolute, 0.25), 0.25);
  EXPECT_EQ(loss_at(LossKind::kAbsolute, -0.25), 0.25);
}

TEST(LossLaw, HuberIsASquareInsideAndLinearBeyond) {
  EXPECT_EQ(loss_at(LossKind::kHuber, 0.0, 2.0), 0.0);
  EXPECT_EQ(loss_at(LossKind::kHuber, -1.5, 2.0), 2.25);
  EXPECT_EQ(loss_at(LossKind::kHuber, 3.0, 2.0), 8.0);
  EXPECT_EQ(loss_at(LossKind::kHuber, -3.0, 2.0), 8.0);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(loss_at(LossKind::kHuber, 2.0 * side, 2.0), 4.0);
    EXPECT_NEAR(slope_at(LossKind::kHuber, 2.0 * side, 2.0), 4.0 * side, 1e-6)
        << "no corner where it becomes linear";
  }
}

TEST(LossLaw, SoftL1IsASquareOfSmallResidualsAndAMagnitudeOfLargeOnes) {
  EXPECT_EQ(loss_at(LossKind::kSoftL1, 0.0, 2.0), 0.0);
  EXPECT_NEAR(loss_at(LossKind::kSoftL1, 2.0, 2.0), 8.0 * (std::sqrt(2.0) - 1.0), 1e-14);
  EXPECT_NEAR(loss_at(LossKind::kSoftL1, -1e-9, 2.0), 1e-18, 1e-33) << "no difference is lost";
  EXPECT_NEAR(loss_at(LossKind::kSoftL1, -1e6, 2.0), 4e6 - 8.0, 1e-4);
}

TEST(LossLaw, BoundsCountOneSideOnly) {
  EXPECT_EQ(loss_at(LossKind::kAbove, 0.0), 0.0);
  EXPECT_EQ(loss_at(LossKind::kAbove, -0.5), 0.0);
  EXPECT_EQ(loss_at(LossKind::kAbove, 0.5), 0.25);
  EXPECT_EQ(loss_at(LossKind::kBelow, 0.0), 0.0);
  EXPECT_EQ(loss_at(LossKind::kBelow, -0.5), 0.25);
  EXPECT_EQ(loss_at(LossKind::kBelow, 0.5), 0.0);
}

TEST(LossLaw, ARowHasOneFunctionAndALossIsNotNegative) {
  std::set<std::string> names;
  for (const LossKind& kind : losses()) {
    SCOPED_TRACE(kind->name);
    EXPECT_TRUE(names.insert(kind->name).second);
    EXPECT_NE(kind->is_square(), static_cast<bool>(kind->value));
    for (const double r : {-1e3, -1.0, -1e-3, 0.0, 1e-3, 1.0, 1e3})
      EXPECT_GE(loss_at(kind, r, 0.3), 0.0) << r;
    EXPECT_EQ(loss_at(kind, 0.7, 0.3) != loss_at(kind, 0.7, 0.4), kind->has_scale);
    const LossValues<double> values{0.7, 0.2, 0.3};
    const double root = loss_root(*kind, values);
    EXPECT_EQ(root * root, kind->is_square() ? weighted_loss(*kind, 1.0, values) : 0.0);
  }
}

TEST(LossLaw, TheWeightIsHalfTheSlopeOverTheResidual) {
  for (const LossKind& kind : losses())
    for (const double r : {-5.0, -0.3, 0.7, 4.0}) {
      if (kind->weight == nullptr) continue;
      EXPECT_NEAR(kind->weight(r, 1.345), slope_at(kind, r, 1.345) / (2.0 * r), 1e-8)
          << kind->name << " at " << r;
    }
}

/// The kinks of a loss of s - 0.5 with the scale 0.2, by the decisions of its recording.
std::vector<int> recorded_kinks(const LossKind& kind, const std::vector<bool>& mode) {
  Recording recording;
  recording.hold(mode);
  recording.record_switches(true);
  const Traced signal(&recording, recording.leaf(0, 0, true));
  const NamedSwitches<Traced> named(signal, *kind);
  weighted_loss(*kind, Traced(1.0), LossValues<Traced>{signal, Traced(0.5), Traced(0.2)});
  std::vector<int> parts;
  for (const SwitchOrigin& origin : recording.switch_origins()) {
    EXPECT_EQ(origin.source->as<LossLaw>(), &*kind);
    parts.push_back(origin.part);
  }
  EXPECT_FALSE(recording.refused());
  return parts;
}

TEST(LossLaw, KinksAreSwitches) {
  using Parts = std::vector<int>;
  EXPECT_EQ(recorded_kinks(LossKind::kSquare, {}), Parts{});
  EXPECT_EQ(recorded_kinks(LossKind::kSoftL1, {}), Parts{});
  for (const LossKind& kind : {LossKind::kAbsolute, LossKind::kAbove, LossKind::kBelow})
    for (const bool is_above : {false, true})
      EXPECT_EQ(recorded_kinks(kind, {is_above}), Parts{kAtReference}) << kind->name;
  EXPECT_EQ(recorded_kinks(LossKind::kHuber, {true}), Parts{kScaleAbove});
  for (const bool is_above : {false, true})
    EXPECT_EQ(recorded_kinks(LossKind::kHuber, {false, is_above}),
              (Parts{kScaleAbove, kScaleBelow}));
}

}  // namespace
}  // namespace codesign
