// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "description/ensemble.h"

namespace codesign {

/// Largest dimension of sobol_points(), which is the dimension of Boost's table of direction
/// numbers.
constexpr int kMaxSobolDimension = 3667;

/// Fills all rows of a matrix with the next points of a sequence, so that a long one need not be in
/// memory as a whole.
using PointSequence = std::function<void(Eigen::MatrixXd*)>;

/// The points of sobol_points(), of any number.
PointSequence sobol_sequence(int dimension, std::uint32_t seed);

/// The first `count` points of a scrambled Sobol sequence, one per row; doc/theory.md (24b). A
/// larger `count` adds rows and a larger `dimension` columns to the same numbers. If `count` is
/// 2^k, each column has exactly one number in each interval [i, i + 1) / 2^k.
/// @param count 0 or more
/// @param dimension from 0 to kMaxSobolDimension, otherwise std::invalid_argument
/// @return count x dimension, odd multiples of 2^-33 inside (0, 1), the same on every platform
Eigen::MatrixXd sobol_points(int count, int dimension, std::uint32_t seed);

/// Points in the open unit cube (0, 1)^d, one per row; doc/theory.md (24b). No coordinate is 0 or
/// 1, so that every distribution has a finite quantile there. The same arguments give the same
/// numbers on every platform.
///
/// kSobol: sobol_points(). kLatinHypercube: each column has exactly one number in each interval [i,
/// i + 1) / count. kRandom: independent. A larger `count` adds rows to the same points with kSobol
/// and kRandom; with kLatinHypercube all points are others.
/// @param count 0 or more
/// @param dimension 0 or more, with kSobol at most kMaxSobolDimension, otherwise
/// std::invalid_argument
/// @return count x dimension
Eigen::MatrixXd unit_points(SamplerKind kind, int count, int dimension, std::uint32_t seed);

/// The same points, part by part. Only kLatinHypercube keeps all of them in memory.
/// @param count number of rows that will be filled altogether.
PointSequence point_sequence(SamplerKind kind, int count, int dimension, std::uint32_t seed);

}  // namespace codesign
