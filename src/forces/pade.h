// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "forces/filter_law.h"

namespace codesign {

constexpr int kMostPade = 10;  ///< the largest order

/// One filter of those that make up Pade's approximation of a delay, theory (49c), an all-pass of
/// first or second order. Its numbers are the delay [s], then `size` and `damping` of its poles.
struct PadeSection {
  FilterKind kind;
  double size;     ///< of its poles times the delay [-]
  double damping;  ///< damping ratio of a pair; unused without
};

/// exp(-s T) of order n over n: q(-s T)/q(s T) with q(x) the sum of (2n - k)! / (k! (n - k)!) x^k.
/// @param order 1 to kMostPade.
std::vector<PadeSection> pade_sections(int order);
/// Whether a filter is such a section.
bool is_pade(const FilterKind& kind);

}  // namespace codesign
