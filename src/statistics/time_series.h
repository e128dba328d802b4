// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace codesign {

/// Lengths of the time series that stand one after the other in the rows of a matrix; positive,
/// their sum is the number of rows.
using SeriesLengths = std::vector<Eigen::Index>;

/// Sums over neighbours in time.
struct SummedSeries {
  Eigen::MatrixXd terms;  ///< one sum per row
  SeriesLengths lengths;  ///< sums of each series
};

/// @param parts numbers of rows that are summed, in the order of the rows; none crosses from one
/// series to the next, and their sum is the number of rows
SummedSeries sums_over(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                       const SeriesLengths& parts);

/// Parts of `size` rows; the last one of each series may be shorter.
SeriesLengths equal_parts(const SeriesLengths& lengths, Eigen::Index size);

/// The covariance of a sum over correlated times.
struct LongRunCovariance {
  Eigen::MatrixXd covariance;  ///< p x p
  int lag = 0;                 ///< lag of the kernel
};

/// The covariance of the sums over all rows of `terms` (p columns of mean about zero), as Newey and
/// West estimate it, on terms made less correlated by an autoregression per column, the mean of
/// orders one and two; doc/theory.md (34), (35). Never negative. Terms of different series are
/// taken as independent.
/// @param lag of the Bartlett kernel; 0: automatic, automatic_lag(). At most a quarter of the rows
/// is used.
LongRunCovariance long_run_covariance(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                                      int lag = 0);

/// The default lag for N rows: the larger of 1.3 sqrt(N) (Lazarus, Lewis, Stock and Watson) and the
/// lag by Andrews for the column whose correlation lasts longest.
int automatic_lag(const Eigen::MatrixXd& terms, const SeriesLengths& lengths);

/// sum_|l| <= lag (1 - |l| / (lag + 1)) Gamma_l with Gamma_l = sum_t x_t x_{t-l}^T over all t of
/// each series: the plain estimate.
Eigen::MatrixXd bartlett_sum(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, int lag);

/// W x with the weights W of the same kernel, so that bartlett_sum() is x^T W x.
Eigen::MatrixXd bartlett_product(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                                 int lag);

/// Draws sums with as many terms as `terms` has rows, in blocks of neighbours (Kuensch's moving
/// blocks), minus their mean; doc/theory.md (36). Blocks do not cross from one series to the next.
/// The same arguments give the same numbers everywhere.
/// @param terms one per row, p columns. @param block neighbours per block, at least 1; of each
/// series at most a quarter
/// @return draws x p
Eigen::MatrixXd bootstrap_sums(const Eigen::MatrixXd& terms, const SeriesLengths& lengths,
                               int block, int draws, std::uint32_t seed);

/// The block that bootstrap_sums() takes of the longest series.
int block_within(const SeriesLengths& lengths, int block);

/// The number below which a fraction of the entries lies, by linear interpolation. @param fraction
/// from 0 to 1
double empirical_quantile(Eigen::VectorXd values, double fraction);

/// The test of Ljung and Box whether residuals are white; doc/theory.md (37).
struct Whiteness {
  double statistic = 0.0;  ///< n (n + 2) sum_k rho_k^2 / (n - k), k = 1 ... lags
  /// probability of a statistic as large or larger if the residuals are white
  double probability = 1.0;
  int lags = 0;
  double first_correlation = 0.0;  ///< rho_1
};

/// @param residuals one output of several recordings below each other, whose means are taken off.
/// @param lags 0: a fifth of the samples, at most 10
Whiteness ljung_box(const Eigen::VectorXd& residuals, const SeriesLengths& lengths, int lags = 0);

}  // namespace codesign
