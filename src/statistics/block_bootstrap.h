// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "statistics/long_run.h"

namespace codesign {

/// Draws sums with as many terms as `terms` has rows, in blocks of neighbours (Kuensch's moving blocks), minus their mean; doc/theory.md
/// (36). Blocks do not cross from one series to the next. The same arguments give the same numbers everywhere.
/// @param terms one per row, p columns. @param block neighbours per block, at least 1; a shorter series is one block
/// @return draws x p
Eigen::MatrixXd bootstrap_sums(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, int block, int draws, std::uint32_t seed);

/// The number below which a fraction of the entries lies, by linear interpolation. @param fraction from 0 to 1
double empirical_quantile(Eigen::VectorXd values, double fraction);

}  // namespace codesign
