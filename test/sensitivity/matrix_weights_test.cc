// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/matrix_weights.h"

#include <gtest/gtest.h>

#include "integration/servo.h"

namespace codesign {
namespace {

constexpr int kPairs = 3;

TEST(MatrixWeights, AreTheSumOfTheOuterProducts) {
  const auto system = servo("{}");
  const IncrementLayout at(system->layout());
  MatrixWeights weights(*system, kPairs + 1);
  std::vector<VectorX<double>> u, mu;
  double next = 0.3;
  const auto fill = [&next](VectorX<double> x) {
    for (double& entry : x) entry = std::sin(next += 1.7);
    return x;
  };
  for (int k = 0; k < kPairs; ++k) {
    u.push_back(fill(VectorX<double>::Zero(at.size())));
    mu.push_back(fill(VectorX<double>::Zero(at.z_size + 1)));
    weights.set(k, u.back(), mu.back());
  }
  const ByVariable<std::vector<double>>& all = weights.compute();
  const auto check = [&](const Sparsity& pattern, const std::vector<double>& found, int first) {
    for (int row = 0; row < pattern.rows; ++row)
      for (int e = pattern.first(row); e < pattern.first(row + 1); ++e) {
        double sum = 0.0;
        for (std::size_t k = 0; k < kPairs; ++k) sum += mu[k][row] * u[k][first + pattern.column(e)];
        EXPECT_NEAR(found[static_cast<std::size_t>(e)], sum, 1e-15 * kPairs);
      }
  };
  check(system->patterns().position, all.position, at.x());
  check(system->patterns().velocity, all.velocity, at.v());
  check(system->patterns().rate, all.rate, at.z());
  weights.clear();
  for (double w : weights.compute().rate) EXPECT_EQ(w, 0.0);
}

}  // namespace
}  // namespace codesign
