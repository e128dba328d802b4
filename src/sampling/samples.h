// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "description/ensemble.h"

namespace codesign {

/// `count` samples of uncertain quantities, equally likely: the quantiles of unit_points(), doc/theory.md (24b). A single sample is drawn
/// like any other; it is not the nominal values. Use another seed for a set that is independent of this one. Quantities that depend on each
/// other are drawn one after the other, each from its distribution given the values drawn before it, (24h).
/// @return count rows with one value per quantity, in their order; of a friction law, its index in `laws`
std::vector<std::vector<double>> draw(const std::vector<UncertainQuantity>& quantities, SamplerKind sampler, int count, std::uint32_t seed);

}  // namespace codesign
