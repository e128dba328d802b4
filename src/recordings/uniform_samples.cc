// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/uniform_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "recordings/recording_check.h"

namespace codesign {
namespace {

/// The slope at sample k of the parabola through it and its neighbours; at an end, of the parabola through the last three samples.
double slope_at(const std::vector<double>& t, const std::vector<double>& x, std::size_t k) {
  const std::size_t middle = std::clamp<std::size_t>(k, 1, t.size() - 2);
  const double h0 = t[middle] - t[middle - 1], h1 = t[middle + 1] - t[middle];
  const double d0 = (x[middle] - x[middle - 1]) / h0, d1 = (x[middle + 1] - x[middle]) / h1;
  if (k < middle) return d0 - h0 * (d1 - d0) / (h0 + h1);
  if (k > middle) return d1 + h1 * (d1 - d0) / (h0 + h1);
  return (h1 * d0 + h0 * d1) / (h0 + h1);
}

/// The value in the interval that begins with sample k, at the fraction `u` of it.
double value_in(const std::vector<double>& t, const std::vector<double>& x, std::size_t k, double u, Between between) {
  const double rise = x[k + 1] - x[k];
  if (between == Between::kLinear) return x[k] + u * rise;
  const double h = t[k + 1] - t[k], from = h * slope_at(t, x, k) - rise, to = rise - h * slope_at(t, x, k + 1);
  return x[k] + u * rise + u * (1.0 - u) * ((1.0 - u) * from + u * to);
}

// Weights of the samples at distances 1, 2, 3, 4; Fornberg, Math. Comput. 51, 699-706 (1988), table 1.
constexpr std::array<std::array<double, 4>, 4> kCentral{{{1.0 / 2.0, 0.0, 0.0, 0.0},
                                                         {2.0 / 3.0, -1.0 / 12.0, 0.0, 0.0},
                                                         {3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0, 0.0},
                                                         {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0}}};

}  // namespace

UniformTimes uniform_times(const std::vector<double>& times) {
  const double period = median_period(times);
  double periods = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k) periods += std::max(1.0, std::round((times[k] - times[k - 1]) / period));
  UniformTimes uniform;
  uniform.start = times.front();
  uniform.step = (times.back() - times.front()) / periods;
  uniform.count = static_cast<Eigen::Index>(periods) + 1;
  double off = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) off = std::max(off, std::abs(times[k] - uniform.at(static_cast<Eigen::Index>(k))));
  constexpr double kJitter = 1e-3;
  uniform.exact = uniform.count == static_cast<Eigen::Index>(times.size()) && off < kJitter * uniform.step;
  return uniform;
}

Eigen::VectorXd resample(const std::vector<double>& times, const std::vector<double>& values, const UniformTimes& uniform,
                         Between between) {
  if (uniform.exact) return Eigen::Map<const Eigen::VectorXd>(values.data(), uniform.count);
  Eigen::VectorXd result(uniform.count);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < uniform.count; ++i) {
    const double t = uniform.at(i);
    while (k + 2 < times.size() && times[k + 1] <= t) ++k;
    const double u = std::clamp((t - times[k]) / (times[k + 1] - times[k]), 0.0, 1.0);
    result[i] = value_in(times, values, k, u, between);
  }
  return result;
}

Eigen::VectorXd derivative(const Eigen::VectorXd& samples, double step) {
  const Eigen::Index n = samples.size();
  Eigen::VectorXd result(n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    const Eigen::Index reach = std::min<Eigen::Index>({4, k, n - 1 - k});
    double sum = 0.0;
    for (Eigen::Index j = 1; j <= reach; ++j)
      sum += kCentral[static_cast<std::size_t>(reach - 1)][static_cast<std::size_t>(j - 1)] * (samples[k + j] - samples[k - j]);
    result[k] = sum / step;
  }
  result[0] = (-1.5 * samples[0] + 2.0 * samples[1] - 0.5 * samples[2]) / step;
  result[n - 1] = (1.5 * samples[n - 1] - 2.0 * samples[n - 2] + 0.5 * samples[n - 3]) / step;
  return result;
}

Eigen::VectorXd integral(const Eigen::VectorXd& samples, double step) {
  const Eigen::Index n = samples.size();
  const auto at = [&samples](Eigen::Index k) { return samples[k]; };
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    double mean = 0.0;
    if (k >= 2 && k + 3 < n)
      mean = (802.0 * (at(k) + at(k + 1)) - 93.0 * (at(k - 1) + at(k + 2)) + 11.0 * (at(k - 2) + at(k + 3))) / 1440.0;
    else if (k >= 1 && k + 2 < n)
      mean = (13.0 * (at(k) + at(k + 1)) - at(k - 1) - at(k + 2)) / 24.0;
    else if (k == 0)
      mean = (9.0 * at(0) + 19.0 * at(1) - 5.0 * at(2) + at(3)) / 24.0;
    else
      mean = (9.0 * at(n - 1) + 19.0 * at(n - 2) - 5.0 * at(n - 3) + at(n - 4)) / 24.0;
    result[k + 1] = result[k] + step * mean;
  }
  return result;
}

}  // namespace codesign
