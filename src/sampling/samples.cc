// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/samples.h"

#include "sampling/distribution.h"
#include "sampling/sampler.h"

namespace codesign {
namespace {

/// The distribution of a quantity, given the values of the quantities before it.
Distribution given(const std::vector<UncertainQuantity>& quantities, std::size_t index, const std::vector<double>& earlier) {
  Distribution distribution = quantities[index].distribution;
  for (const MeanSlope& on : quantities[index].slopes)
    distribution.mean += on.slope * (earlier[on.quantity] - quantities[on.quantity].distribution.mean);
  return distribution;
}

}  // namespace

std::vector<std::vector<double>> draw(const std::vector<UncertainQuantity>& quantities, SamplerKind sampler, int count,
                                      std::uint32_t seed) {
  const Eigen::MatrixXd points = unit_points(sampler, count, static_cast<int>(quantities.size()), seed);
  std::vector<std::vector<double>> samples(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].reserve(quantities.size());
    for (std::size_t j = 0; j < quantities.size(); ++j) {
      samples[i].push_back(quantile(given(quantities, j, samples[i]), points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    }
  }
  return samples;
}

}  // namespace codesign
