// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sampler.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "math/arrays.h"

namespace codesign {
namespace {

// The largest number below one.
constexpr double kBelowOne = 1.0 - 0x1p-53;

// Raw 32-bit numbers: the standard defines their sequence, but not the algorithms of <random>'s
// distributions.
std::uint32_t draw_bits(std::mt19937* generator) {
  return static_cast<std::uint32_t>((*generator)());
}

// From 52 random bits of two draws: an odd multiple of 2^-53, inside (0, 1) and without rounding.
double draw_unit(std::mt19937* generator) {
  const std::uint32_t high = draw_bits(generator) >> 6, low = draw_bits(generator) >> 6;
  return (high * 0x1p26 + low + 0.5) * 0x1p-52;
}

// A whole number from 0 to size - 1; the numbers' probabilities differ by 2^-32 at most.
std::size_t draw_below(std::size_t size, std::mt19937* generator) {
  return to_index((std::uint64_t{draw_bits(generator)} * size) >> 32);
}

PointSequence random_sequence(std::uint32_t seed) {
  return [generator = std::mt19937(seed)](Eigen::MatrixXd* points) mutable {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      for (Eigen::Index j = 0; j < points->cols(); ++j) (*points)(i, j) = draw_unit(&generator);
    }
  };
}

// Each column has the intervals in a random order (Fisher and Yates) and a random place in each
// interval.
Eigen::MatrixXd latin_hypercube(int count, int dimension, std::uint32_t seed) {
  std::mt19937 generator(seed);
  Eigen::MatrixXd points(count, dimension);
  std::vector<int> intervals(to_index(count));
  for (int j = 0; j < dimension; ++j) {
    std::iota(intervals.begin(), intervals.end(), 0);
    for (std::size_t left = intervals.size(); left > 1; --left)
      std::swap(intervals[left - 1], intervals[draw_below(left, &generator)]);
    for (int i = 0; i < count; ++i) {
      const double place = (draw_bits(&generator) + 0.5) * 0x1p-32;
      points(i, j) = std::min((intervals[to_index(i)] + place) / count, kBelowOne);
    }
  }
  return points;
}

// The columns are drawn one after the other, so that all points must be there before the first one
// is taken.
PointSequence latin_sequence(int count, int dimension, std::uint32_t seed) {
  return [all = latin_hypercube(count, dimension, seed),
          taken = Eigen::Index{0}](Eigen::MatrixXd* points) mutable {
    *points = all.middleRows(taken, points->rows());
    taken += points->rows();
  };
}

// Direction numbers of Joe and Kuo, new-joe-kuo-6; doc/theory.md [17].
using Engine = boost::random::sobol_engine<std::uint32_t, 32>;
static_assert(boost::random::default_sobol_table::max_dimension == kMaxSobolDimension);

std::uint32_t reverse_bits(std::uint32_t x) {
  x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
  return (x << 16) | (x >> 16);
}

// Owen's scrambling: each bit is flipped or not as a function of the bits above it, so that every
// net stays a net. The hash is by Laine and Karras, with Burley's constants, doc/theory.md [18]. In
// the hash a bit depends on the bits below it, hence the reversal. A random digital shift would
// keep the nets too, but flips a bit everywhere or nowhere: at best the error of a mean falls as
// N^-1 then, and as N^-1.5 here.
std::uint32_t scramble(std::uint32_t x, std::uint32_t key) {
  x = reverse_bits(x) + key;
  for (const std::uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u})
    x ^= x * factor;
  return reverse_bits(x);
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

PointSequence sobol_sequence(int dimension, std::uint32_t seed) {
  if (dimension == 0) return [](Eigen::MatrixXd*) {};
  const auto size = to_index(dimension);
  // The standard defines its raw numbers, but not the algorithms of <random>'s distributions.
  std::mt19937 generator(seed);
  std::vector<std::uint32_t> keys(size);
  for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(generator());
  return [engine = Engine(size), keys, bits = std::vector<std::uint32_t>(size, 0u),
          is_first = true](Eigen::MatrixXd* points) mutable {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      // Boost leaves out the first point, zero, without which the first 2^k points are no net.
      if (!is_first) engine.generate(bits.begin(), bits.end());
      is_first = false;
      for (std::size_t j = 0; j < keys.size(); ++j)
        (*points)(i, to_signed(j)) = (scramble(bits[j], keys[j]) + 0.5) * 0x1p-32;
    }
  };
}

Eigen::MatrixXd sobol_points(int count, int dimension, std::uint32_t seed) {
  Eigen::MatrixXd points(count, dimension);
  sobol_sequence(dimension, seed)(&points);
  return points;
}

}  // namespace codesign
