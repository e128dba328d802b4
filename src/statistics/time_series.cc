// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/time_series.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

// Andrews and Monahan: nearer to one, the recolored variance has no finite variance of its own.
constexpr double kMostCorrelated = 0.97;

/// The autoregression of order one or two of each column, x_t = first x_{t-1} + second x_{t-2} +
/// innovation, by partial correlations (Levinson and Durbin).
struct Autoregression {
  Eigen::VectorXd partial_first, partial_second;  ///< magnitude at most kMostCorrelated
  Eigen::VectorXd first, second;                  ///< sum at most kMostCorrelated
};

/// sum_t x_t x_{t-lag} within each series, per column.
Eigen::VectorXd products_at(int lag, const Eigen::MatrixXd& terms, const SeriesLengths& lengths) {
  Eigen::VectorXd products = Eigen::VectorXd::Zero(terms.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const Eigen::Index pairs = std::max<Eigen::Index>(0, length - lag);
    products += (terms.middleRows(begin, pairs).array() *
                 terms.middleRows(begin + length - pairs, pairs).array())
                    .colwise()
                    .sum()
                    .matrix()
                    .transpose();
    begin += length;
  }
  return products;
}

double clamped(double correlation) {
  return std::clamp(correlation, -kMostCorrelated, kMostCorrelated);
}

Autoregression autoregression(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                              int order) {
  const Eigen::VectorXd squares = products_at(0, terms, lengths),
                        one = products_at(1, terms, lengths), two = products_at(2, terms, lengths);
  Autoregression result;
  for (Eigen::VectorXd* each :
       {&result.partial_first, &result.partial_second, &result.first, &result.second})
    each->setZero(terms.cols());
  for (Eigen::Index k = 0; k < terms.cols(); ++k) {
    if (!(squares[k] > 0.0)) continue;
    const double p = clamped(one[k] / squares[k]),
                 q = order > 1 ? clamped((two[k] / squares[k] - p * p) / (1.0 - p * p)) : 0.0;
    const double scale = std::min(1.0, kMostCorrelated / std::max(p * (1.0 - q) + q, 1e-9));
    result.partial_first[k] = p;
    result.partial_second[k] = q;
    result.first[k] = scale * p * (1.0 - q);
    result.second[k] = scale * q;
  }
  return result;
}

/// The innovations; those of the first two rows, which lack predecessors, are scaled to the same
/// variance.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                         const Autoregression& by) {
  Eigen::MatrixXd result = terms;
  const auto part = [](const Eigen::VectorXd& partial) {
    return (1.0 - partial.array().square()).sqrt().matrix().asDiagonal();
  };
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const Eigen::Index rest = std::max<Eigen::Index>(0, length - 2);
    result.middleRows(begin + length - rest, rest) -=
        terms.middleRows(begin + 1, rest) * by.first.asDiagonal() +
        terms.middleRows(begin, rest) * by.second.asDiagonal();
    if (length > 1) {
      result.row(begin + 1) -= terms.row(begin) * by.partial_first.asDiagonal();
      result.row(begin + 1) *= part(by.partial_second);
    }
    result.row(begin) *= part(by.partial_first);
    result.row(begin) *= part(by.partial_second);
    begin += length;
  }
  return result;
}

int capped(double lag, Eigen::Index rows) {
  const double most = std::max(1.0, std::floor(0.25 * static_cast<double>(rows)));
  return static_cast<int>(std::clamp(std::floor(lag), 1.0, most));
}

/// A whole number from 0 to size - 1, made from raw bits: the standard defines their sequence, but
/// not the algorithms of <random>'s distributions.
Eigen::Index draw_index(Eigen::Index size, std::mt19937* generator) {
  const auto bits = static_cast<std::uint64_t>((*generator)());
  return to_signed((bits * static_cast<std::uint64_t>(size)) >> 32);
}

/// One series: sums over the rows before k, so that a block is a difference of two.
Eigen::MatrixXd running_sums(const Eigen::MatrixXd& terms, Eigen::Index begin,
                             Eigen::Index length) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(length + 1, terms.cols());
  for (Eigen::Index k = 0; k < length; ++k) sums.row(k + 1) = sums.row(k) + terms.row(begin + k);
  return sums;
}

/// Longer blocks of a series would begin at too few places to differ from draw to draw.
Eigen::Index longest_block(Eigen::Index length) { return std::max<Eigen::Index>(1, length / 4); }

/// Adds to each draw the sum over blocks of one series. The last block is cut to the missing
/// length.
void add_series(const Eigen::MatrixXd& sums, Eigen::Index block, std::mt19937* generator,
                Eigen::MatrixXd* draws) {
  const Eigen::Index length = sums.rows() - 1, size = std::min(block, longest_block(length)),
                     starts = length - size + 1;
  for (Eigen::Index draw = 0; draw < draws->rows(); ++draw)
    for (Eigen::Index filled = 0; filled < length; filled += size) {
      const Eigen::Index start = draw_index(starts, generator),
                         part = std::min(size, length - filled);
      draws->row(draw) += sums.row(start + part) - sums.row(start);
    }
}

}  // namespace

SummedSeries sums_over(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                       const SeriesLengths& parts) {
  SummedSeries sums{Eigen::MatrixXd(to_signed(parts.size()), terms.cols()), {}};
  Eigen::Index begin = 0, end = 0, sum = 0;
  for (const Eigen::Index length : lengths) {
    end += length;
    const Eigen::Index first = sum;
    for (; begin < end; ++sum) {
      sums.terms.row(sum) = terms.middleRows(begin, parts[to_index(sum)]).colwise().sum();
      begin += parts[to_index(sum)];
    }
    sums.lengths.push_back(sum - first);
  }
  return sums;
}

SeriesLengths equal_parts(const SeriesLengths& lengths, Eigen::Index size) {
  SeriesLengths parts;
  for (const Eigen::Index length : lengths)
    for (Eigen::Index begin = 0; begin < length; begin += size)
      parts.push_back(std::min(size, length - begin));
  return parts;
}

int automatic_lag(const Eigen::MatrixXd& terms, const SeriesLengths& lengths) {
  const auto rows = static_cast<double>(terms.rows());
  double lag = 1.3 * std::sqrt(rows);
  for (const double slope : autoregression(terms, lengths, 1).partial_first) {
    const double alpha = std::pow(2.0 * slope / (1.0 - slope * slope), 2.0);
    lag = std::max(lag, 1.1447 * std::cbrt(alpha * rows));
  }
  return capped(lag, terms.rows());
}

// Each term lies in lag + 1 windows of lag + 1 neighbours, and a share 1 - |l| / (lag + 1) of them
// contains its neighbour at distance l, too. The sum is therefore computed over windows, with zeros
// before and after the series, in N p^2 operations for any lag.
Eigen::MatrixXd bartlett_sum(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, int lag) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(terms.cols(), terms.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    Eigen::MatrixXd windows(length + lag, terms.cols());
    Eigen::RowVectorXd window = Eigen::RowVectorXd::Zero(terms.cols());
    for (Eigen::Index k = 0; k < windows.rows(); ++k) {
      if (k < length) window += terms.row(begin + k);
      if (k > lag) window -= terms.row(begin + k - lag - 1);
      windows.row(k) = window;
    }
    sum.noalias() += windows.transpose() * windows;
    begin += length;
  }
  return sum / (lag + 1.0);
}

// Sums over windows that end at a row, then over windows that begin there.
Eigen::MatrixXd bartlett_product(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                                 int lag) {
  Eigen::MatrixXd result(terms.rows(), terms.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const Eigen::MatrixXd sums = running_sums(terms, begin, length);
    // Every longer window is the whole series.
    const Eigen::Index within = std::min<Eigen::Index>(lag, length - 1);
    const Eigen::RowVectorXd beyond = static_cast<double>(lag - within) * sums.row(length);
    Eigen::RowVectorXd both = Eigen::RowVectorXd::Zero(terms.cols());
    const auto window = [&](Eigen::Index end) {
      return sums.row(std::min(end + 1, length)) -
             sums.row(std::max<Eigen::Index>(end - within, 0));
    };
    for (Eigen::Index end = 0; end < within; ++end) both += window(end);
    for (Eigen::Index k = 0; k < length; ++k) {
      both += window(k + within);
      result.row(begin + k) = (both + beyond) / (lag + 1.0);
      both -= window(k);
    }
    begin += length;
  }
  return result;
}

LongRunCovariance long_run_covariance(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                                      int lag) {
  LongRunCovariance result;
  result.covariance.setZero(terms.cols(), terms.cols());
  constexpr int kOrders = 2;
  for (int order = 1; order <= kOrders; ++order) {
    const Autoregression by = autoregression(terms, lengths, order);
    const Eigen::MatrixXd innovations = whitened(terms, lengths, by);
    if (order == 1)
      result.lag = lag > 0 ? capped(lag, terms.rows()) : automatic_lag(innovations, lengths);
    const Eigen::VectorXd recolor = (1.0 - by.first.array() - by.second.array()).inverse();
    result.covariance += recolor.asDiagonal() * bartlett_sum(innovations, lengths, result.lag) *
                         recolor.asDiagonal() / kOrders;
  }
  return result;
}

int block_within(const SeriesLengths& lengths, int block) {
  const Eigen::Index longest = *std::max_element(lengths.begin(), lengths.end());
  return static_cast<int>(std::min<Eigen::Index>(block, longest_block(longest)));
}

Eigen::MatrixXd bootstrap_sums(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                               int block, int draws, std::uint32_t seed) {
  std::mt19937 generator(seed);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(draws, terms.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    add_series(running_sums(terms, begin, length), block, &generator, &result);
    begin += length;
  }
  return about_mean_of(std::move(result));
}

double empirical_quantile(Eigen::VectorXd values, double fraction) {
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  const Eigen::Index above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

Whiteness ljung_box(const Eigen::VectorXd& residuals, const SeriesLengths& lengths, int lags) {
  constexpr Eigen::Index kMostLags = 10, kPart = 5;
  const Eigen::Index count = residuals.size();
  Whiteness result;
  result.lags =
      lags > 0 ? lags : static_cast<int>(std::clamp<Eigen::Index>(count / kPart, 1, kMostLags));
  Eigen::VectorXd products = Eigen::VectorXd::Zero(result.lags + 1);
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const Eigen::VectorXd centered = about_mean_of(residuals.segment(begin, length));
    for (Eigen::Index lag = 0; lag < std::min<Eigen::Index>(length, result.lags + 1); ++lag)
      products[lag] += centered.head(length - lag).dot(centered.tail(length - lag));
    begin += length;
  }
  if (!(products[0] > 0.0)) return result;
  const auto n = static_cast<double>(count);
  for (Eigen::Index lag = 1; lag <= result.lags; ++lag) {
    const double correlation = products[lag] / products[0];
    if (lag == 1) result.first_correlation = correlation;
    result.statistic += n * (n + 2.0) * correlation * correlation / (n - static_cast<double>(lag));
  }
  result.probability = chi_squared_tail(result.statistic, result.lags);
  return result;
}

}  // namespace codesign
