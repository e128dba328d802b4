// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/residual_spreads.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

/// Two outputs; of the second one two residuals do not count, whatever they are.
TEST(ResidualSpreads, CountWhatCounts) {
  Eigen::MatrixXd residuals(4, 2), counted(4, 2);
  residuals << 1.0, 3.0, -1.0, 7.0, 1.0, 4.0, -1.0, -9.0;
  counted << 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  EXPECT_DOUBLE_EQ(rms_of(residuals, counted)[0], 1.0);
  EXPECT_DOUBLE_EQ(rms_of(residuals, counted)[1], std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(rms_of(residuals, {})[1], std::sqrt(38.75));
  LossOptions robust;
  robust.kind = LossKind::kHuber;
  EXPECT_DOUBLE_EQ(spreads_of(residuals, robust, counted)[1], 1.4826 * 4.0);
  EXPECT_DOUBLE_EQ(mean_spread(residuals, {}, counted), std::sqrt(std::sqrt(12.5)));
}

}  // namespace
}  // namespace codesign
