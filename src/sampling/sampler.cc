// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sampler.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "sampling/sobol.h"

namespace codesign {
namespace {

// The largest number below one.
constexpr double kBelowOne = 1.0 - 0x1p-53;

// Raw 32-bit numbers: the standard defines their sequence, but not the algorithms of <random>'s distributions.
std::uint32_t draw_bits(std::mt19937* generator) { return static_cast<std::uint32_t>((*generator)()); }

// From 52 random bits of two draws: an odd multiple of 2^-53, inside (0, 1) and without rounding.
double draw_unit(std::mt19937* generator) {
  const std::uint32_t high = draw_bits(generator) >> 6, low = draw_bits(generator) >> 6;
  return (high * 0x1p26 + low + 0.5) * 0x1p-52;
}

// A whole number from 0 to size - 1; the numbers' probabilities differ by 2^-32 at most.
std::size_t draw_below(std::size_t size, std::mt19937* generator) {
  return static_cast<std::size_t>((std::uint64_t{draw_bits(generator)} * size) >> 32);
}

PointSequence random_sequence(std::uint32_t seed) {
  return [generator = std::mt19937(seed)](Eigen::MatrixXd* points) mutable {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      for (Eigen::Index j = 0; j < points->cols(); ++j) (*points)(i, j) = draw_unit(&generator);
    }
  };
}

// Each column has the intervals in a random order (Fisher and Yates) and a random place in each interval.
Eigen::MatrixXd latin_hypercube(int count, int dimension, std::uint32_t seed) {
  std::mt19937 generator(seed);
  Eigen::MatrixXd points(count, dimension);
  std::vector<int> intervals(static_cast<std::size_t>(count));
  for (int j = 0; j < dimension; ++j) {
    std::iota(intervals.begin(), intervals.end(), 0);
    for (std::size_t left = intervals.size(); left > 1; --left) std::swap(intervals[left - 1], intervals[draw_below(left, &generator)]);
    for (int i = 0; i < count; ++i) {
      const double place = (draw_bits(&generator) + 0.5) * 0x1p-32;
      points(i, j) = std::min((intervals[static_cast<std::size_t>(i)] + place) / count, kBelowOne);
    }
  }
  return points;
}

// The columns are drawn one after the other, so that all points must be there before the first one is taken.
PointSequence latin_sequence(int count, int dimension, std::uint32_t seed) {
  return [all = latin_hypercube(count, dimension, seed), taken = Eigen::Index{0}](Eigen::MatrixXd* points) mutable {
    *points = all.middleRows(taken, points->rows());
    taken += points->rows();
  };
}

}  // namespace

PointSequence point_sequence(SamplerKind kind, int count, int dimension, std::uint32_t seed) {
  switch (kind) {
    case SamplerKind::kSobol:
      return sobol_sequence(dimension, seed);
    case SamplerKind::kLatinHypercube:
      return latin_sequence(count, dimension, seed);
    case SamplerKind::kRandom:
      break;
  }
  return random_sequence(seed);
}

Eigen::MatrixXd unit_points(SamplerKind kind, int count, int dimension, std::uint32_t seed) {
  Eigen::MatrixXd points(count, dimension);
  point_sequence(kind, count, dimension, seed)(&points);
  return points;
}

}  // namespace codesign
