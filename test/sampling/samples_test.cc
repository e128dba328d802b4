// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/samples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sampling/distribution.h"
#include "sampling/sampler.h"

namespace codesign {
namespace {

UncertainQuantity quantity(const Distribution& distribution) { return {"quantity", 0, distribution, {}, {}}; }

std::vector<UncertainQuantity> quantities() {
  return {quantity({DistributionKind::kUniform, 0.0, 0.0, 0.2, 0.4, {}}), quantity({DistributionKind::kNormal, 1.0, 0.1, 0.7, 1.3, {}}),
          quantity({DistributionKind::kChoice, 0.0, 0.0, 0.0, 0.0, {0.0, 1.0, 2.0, 3.0}})};
}

TEST(Samples, AreQuantilesOfUnitPoints) {
  const auto samples = draw(quantities(), SamplerKind::kLatinHypercube, 6, 9);
  const Eigen::MatrixXd points = unit_points(SamplerKind::kLatinHypercube, 6, 3, 9);
  ASSERT_EQ(samples.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(samples[i].size(), 3u);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(samples[i][j], quantile(quantities()[j].distribution, points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    }
  }
}

TEST(Samples, HaveTheMeansOfTheirDistributions) {
  double uniform = 0.0, normal = 0.0;
  std::vector<int> chosen(4, 0);
  for (const auto& sample : draw(quantities(), SamplerKind::kSobol, 256, 1)) {
    uniform += sample[0] / 256.0;
    normal += sample[1] / 256.0;
    ++chosen[static_cast<std::size_t>(sample[2])];
  }
  EXPECT_NEAR(uniform, 0.3, 1e-4);
  EXPECT_NEAR(normal, 1.0, 1e-4);
  EXPECT_EQ(chosen, std::vector<int>(4, 64));
}

TEST(Samples, OneIsDrawnLikeTheFirstOfMany) {
  const auto one = draw(quantities(), SamplerKind::kSobol, 1, 4), many = draw(quantities(), SamplerKind::kSobol, 8, 4);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0], many[0]);
}

TEST(Samples, OfNothingAreEmptyRows) { EXPECT_EQ(draw({}, SamplerKind::kSobol, 3, 1), std::vector<std::vector<double>>(3)); }

}  // namespace
}  // namespace codesign
