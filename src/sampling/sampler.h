// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "description/ensemble.h"
#include "sampling/sobol.h"

namespace codesign {

/// Points in the open unit cube (0, 1)^d, one per row; doc/theory.md (24b). No coordinate is 0 or 1, so that every distribution has a
/// finite quantile there. The same arguments give the same numbers on every platform.
///
/// kSobol: sobol_points(). kLatinHypercube: each column has exactly one number in each interval [i, i + 1) / count. kRandom: independent.
/// A larger `count` adds rows to the same points with kSobol and kRandom; with kLatinHypercube all points are others.
/// @param count 0 or more
/// @param dimension 0 or more, with kSobol at most kMaxSobolDimension (sobol.h), otherwise std::invalid_argument
/// @return count x dimension
Eigen::MatrixXd unit_points(SamplerKind kind, int count, int dimension, std::uint32_t seed);

/// The same points, part by part. Only kLatinHypercube keeps all of them in memory.
/// @param count number of rows that will be filled altogether.
PointSequence point_sequence(SamplerKind kind, int count, int dimension, std::uint32_t seed);

}  // namespace codesign
