// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/whiteness.h"

#include <algorithm>

#include "statistics/quantiles.h"

namespace codesign {

Whiteness ljung_box(const Eigen::VectorXd& residuals, const SeriesLengths& lengths, int lags) {
  constexpr Eigen::Index kMostLags = 10, kPart = 5;
  const Eigen::Index count = residuals.size();
  Whiteness result;
  result.lags = lags > 0 ? lags : static_cast<int>(std::clamp<Eigen::Index>(count / kPart, 1, kMostLags));
  Eigen::VectorXd products = Eigen::VectorXd::Zero(result.lags + 1);
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    const Eigen::VectorXd centered = residuals.segment(begin, length).array() - residuals.segment(begin, length).mean();
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
