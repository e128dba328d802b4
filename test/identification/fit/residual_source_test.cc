// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "identification/fit/residual_source.h"

namespace codesign {
namespace {

TEST(Loss, ASumOfSquares) {
  const LossValue value = loss_of({LossKind::kSquare, 1.0}, -3.0);
  EXPECT_EQ(value.value, 9.0);
  EXPECT_EQ(value.weight, 1.0);
}

TEST(Loss, HuberIsQuadraticInsideAndLinearBeyond) {
  const LossOptions options{LossKind::kHuber, 2.0};
  EXPECT_EQ(loss_of(options, 0.0).value, 0.0);
  EXPECT_EQ(loss_of(options, 2.0).value, 4.0);
  EXPECT_EQ(loss_of(options, 2.0).weight, 1.0);
  EXPECT_EQ(loss_of(options, -3.0).value, 8.0);
  EXPECT_EQ(loss_of(options, -3.0).weight, 2.0 / 3.0);
}

TEST(Loss, SoftL1) {
  const LossOptions options{LossKind::kSoftL1, 2.0};
  EXPECT_EQ(loss_of(options, 0.0).value, 0.0);
  EXPECT_EQ(loss_of(options, 0.0).weight, 1.0);
  EXPECT_NEAR(loss_of(options, 2.0).value, 8.0 * (std::sqrt(2.0) - 1.0), 1e-14);
  EXPECT_NEAR(loss_of(options, 1e6).value, 4e6, 10.0) << "the same slope as a Huber loss far out";
}

TEST(Loss, TheWeightIsHalfTheSlopeOverTheResidual) {
  for (const LossKind& kind : {LossKind::kSquare, LossKind::kHuber, LossKind::kSoftL1})
    for (const double u : {-5.0, -0.3, 0.7, 4.0}) {
      const LossOptions options{kind, 1.345};
      const double h = 1e-6;
      const double slope =
          (loss_of(options, u + h).value - loss_of(options, u - h).value) / (2.0 * h);
      EXPECT_NEAR(loss_of(options, u).weight, slope / (2.0 * u), 1e-8) << kind->name << " at " << u;
    }
}

}  // namespace

}  // namespace codesign
