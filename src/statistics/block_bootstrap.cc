// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/block_bootstrap.h"

#include <algorithm>
#include <random>

namespace codesign {
namespace {

/// A whole number from 0 to size - 1, made from raw bits: the standard defines their sequence, but not the algorithms of <random>'s
/// distributions.
Eigen::Index draw_index(Eigen::Index size, std::mt19937* generator) {
  const auto bits = static_cast<std::uint64_t>((*generator)());
  return static_cast<Eigen::Index>((bits * static_cast<std::uint64_t>(size)) >> 32);
}

/// One series: sums over the rows before k, so that a block is a difference of two.
Eigen::MatrixXd running_sums(const Eigen::MatrixXd& terms, Eigen::Index begin, Eigen::Index length) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(length + 1, terms.cols());
  for (Eigen::Index k = 0; k < length; ++k) sums.row(k + 1) = sums.row(k) + terms.row(begin + k);
  return sums;
}

/// Adds to each draw the sum over blocks of one series. The last block is cut to the missing length.
void add_series(const Eigen::MatrixXd& sums, Eigen::Index block, std::mt19937* generator, Eigen::MatrixXd* draws) {
  const Eigen::Index length = sums.rows() - 1, size = std::min(block, length), starts = length - size + 1;
  for (Eigen::Index draw = 0; draw < draws->rows(); ++draw)
    for (Eigen::Index filled = 0; filled < length; filled += size) {
      const Eigen::Index start = draw_index(starts, generator), part = std::min(size, length - filled);
      draws->row(draw) += sums.row(start + part) - sums.row(start);
    }
}

}  // namespace

Eigen::MatrixXd bootstrap_sums(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, int block, int draws, std::uint32_t seed) {
  std::mt19937 generator(seed);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(draws, terms.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    add_series(running_sums(terms, begin, length), block, &generator, &result);
    begin += length;
  }
  const Eigen::RowVectorXd mean = result.colwise().mean();
  result.rowwise() -= mean;
  return result;
}

double empirical_quantile(Eigen::VectorXd values, double fraction) {
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<Eigen::Index>(place);
  const Eigen::Index above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace codesign
