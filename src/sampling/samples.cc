// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/samples.h"

#include "sampling/distribution.h"
#include "sampling/sampler.h"

namespace codesign {

std::vector<std::vector<double>> draw(const std::vector<UncertainQuantity>& quantities, SamplerKind sampler, int count,
                                      std::uint32_t seed) {
  const Eigen::MatrixXd points = unit_points(sampler, count, static_cast<int>(quantities.size()), seed);
  std::vector<std::vector<double>> samples(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].reserve(quantities.size());
    for (std::size_t j = 0; j < quantities.size(); ++j) {
      samples[i].push_back(quantile(quantities[j].distribution, points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    }
  }
  return samples;
}

}  // namespace codesign
