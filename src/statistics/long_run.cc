// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/long_run.h"

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

// Andrews and Monahan: nearer to one, the recolored variance has no finite variance of its own.
constexpr double kMostCorrelated = 0.97;

/// Slope of x_t over x_{t-1}, per column.
Eigen::VectorXd autoregression(const Eigen::MatrixXd& terms, const SeriesLengths& lengths) {
  Eigen::VectorXd products = Eigen::VectorXd::Zero(terms.cols()), squares = products;
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const auto before = terms.middleRows(begin, length - 1), after = terms.middleRows(begin + 1, length - 1);
    products += (before.array() * after.array()).colwise().sum().matrix().transpose();
    squares += before.colwise().squaredNorm().transpose();
    begin += length;
  }
  Eigen::VectorXd slopes(terms.cols());
  for (Eigen::Index k = 0; k < slopes.size(); ++k)
    slopes[k] = squares[k] > 0.0 ? std::clamp(products[k] / squares[k], -kMostCorrelated, kMostCorrelated) : 0.0;
  return slopes;
}

/// x_t - slope x_{t-1}; the first row of a series, which has no predecessor, is scaled to the same variance.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, const Eigen::VectorXd& slopes) {
  Eigen::MatrixXd result = terms;
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    result.middleRows(begin + 1, length - 1) -= terms.middleRows(begin, length - 1) * slopes.asDiagonal();
    result.row(begin) *= (1.0 - slopes.array().square()).sqrt().matrix().asDiagonal();
    begin += length;
  }
  return result;
}

int capped(double lag, Eigen::Index rows) {
  const double most = std::max(1.0, std::floor(0.25 * static_cast<double>(rows)));
  return static_cast<int>(std::clamp(std::floor(lag), 1.0, most));
}

}  // namespace

int automatic_lag(const Eigen::MatrixXd& terms, const SeriesLengths& lengths) {
  const auto rows = static_cast<double>(terms.rows());
  double lag = 1.3 * std::sqrt(rows);
  for (const double slope : autoregression(terms, lengths)) {
    const double alpha = std::pow(2.0 * slope / (1.0 - slope * slope), 2.0);
    lag = std::max(lag, 1.1447 * std::cbrt(alpha * rows));
  }
  return capped(lag, terms.rows());
}

// Each term lies in lag + 1 windows of lag + 1 neighbours, and a share 1 - |l| / (lag + 1) of them contains its neighbour at distance l,
// too. The sum is therefore computed over windows, with zeros before and after the series, in N p^2 operations for any lag.
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

LongRunCovariance long_run_covariance(const Eigen::MatrixXd& terms, const SeriesLengths& lengths, int lag) {
  const Eigen::VectorXd slopes = autoregression(terms, lengths);
  const Eigen::MatrixXd innovations = whitened(terms, lengths, slopes);
  LongRunCovariance result;
  result.lag = lag > 0 ? capped(lag, terms.rows()) : automatic_lag(innovations, lengths);
  const Eigen::VectorXd recolor = (1.0 - slopes.array()).inverse();
  result.covariance = recolor.asDiagonal() * bartlett_sum(innovations, lengths, result.lag) * recolor.asDiagonal();
  // Fixed-b asymptotics for kernels whose width is the fraction b of the sample: mean and degrees of freedom of the estimate.
  const double b = (result.lag + 1.0) / static_cast<double>(terms.rows());
  result.covariance /= 1.0 - b + b * b / 3.0;
  result.degrees = 1.5 / b;
  return result;
}

}  // namespace codesign
