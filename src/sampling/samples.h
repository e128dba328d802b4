// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "description/ensemble.h"

namespace codesign {

/// `count` samples of uncertain quantities, equally likely: the quantiles of unit_points(),
/// doc/theory.md (24b). A single sample is drawn like any other; it is not the nominal values. Use
/// another seed for a set that is independent of this one. Quantities that depend on each other are
/// drawn one after the other, each from its distribution given the values drawn before it, (24h).
/// @return count rows with one value per quantity, in their order; of a friction law, its index in
/// `laws`
std::vector<std::vector<double>> draw(const std::vector<UncertainQuantity>& quantities,
                                      SamplerKind sampler, int count, std::uint32_t seed);

/// Samples at the corners of what is uncertain: of all combinations of both ends of the uniform
/// quantities and of all choices one sample, in which normal ones have their mean; none without a
/// uniform quantity, and none if they were more than kMostCorners. Ends lie 2^-33 of an interval
/// inside it, as the points of a sampler do.
std::vector<std::vector<double>> corners(const std::vector<UncertainQuantity>& quantities);
constexpr std::size_t kMostCorners = 64;

/// The value below which a number of this distribution lies with probability u; doc/theory.md
/// (24b).
///
/// kNormal is exact to about 1e-14 of the larger of `deviation` and the distance from the mean,
/// however far out it is truncated. Where nothing of the normal distribution is left between the
/// bounds (38 deviations away), the value is the bound nearest to the mean. kChoice divides (0, 1)
/// into equal parts, in the order of `choices`.
/// @param u in the open interval (0, 1), as unit_points() gives it; 0 and 1 give the bounds,
/// infinite ones where there are none
/// @param distribution kUniform: finite bounds; kNormal: `deviation` 0 or more; kChoice: at least
/// one choice
double quantile(const Distribution& distribution, double u);

}  // namespace codesign
