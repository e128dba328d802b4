// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sobol.h"

#include <boost/random/sobol.hpp>
#include <random>
#include <vector>

namespace codesign {
namespace {

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

// Owen's scrambling: each bit is flipped or not as a function of the bits above it, so that every net stays a net. The hash is by Laine and
// Karras, with Burley's constants, doc/theory.md [18]. In the hash a bit depends on the bits below it, hence the reversal. A random digital
// shift would keep the nets too, but flips a bit everywhere or nowhere: at best the error of a mean falls as N^-1 then, and as N^-1.5 here.
std::uint32_t scramble(std::uint32_t x, std::uint32_t key) {
  x = reverse_bits(x) + key;
  for (const std::uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u}) x ^= x * factor;
  return reverse_bits(x);
}

}  // namespace

PointSequence sobol_sequence(int dimension, std::uint32_t seed) {
  if (dimension == 0) return [](Eigen::MatrixXd*) {};
  const auto size = static_cast<std::size_t>(dimension);
  std::mt19937 generator(seed);  // the standard defines its raw numbers, but not the algorithms of <random>'s distributions
  std::vector<std::uint32_t> keys(size);
  for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(generator());
  return [engine = Engine(size), keys, bits = std::vector<std::uint32_t>(size, 0u), is_first = true](Eigen::MatrixXd* points) mutable {
    for (Eigen::Index i = 0; i < points->rows(); ++i) {
      // Boost leaves out the first point, zero, without which the first 2^k points are no net.
      if (!is_first) engine.generate(bits.begin(), bits.end());
      is_first = false;
      for (std::size_t j = 0; j < keys.size(); ++j)
        (*points)(i, static_cast<Eigen::Index>(j)) = (scramble(bits[j], keys[j]) + 0.5) * 0x1p-32;
    }
  };
}

Eigen::MatrixXd sobol_points(int count, int dimension, std::uint32_t seed) {
  Eigen::MatrixXd points(count, dimension);
  sobol_sequence(dimension, seed)(&points);
  return points;
}

}  // namespace codesign
