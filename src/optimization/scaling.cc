// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/scaling.h"

#include <algorithm>
#include <cmath>

#include "description/tuned_parameters.h"
#include "math/arrays.h"

namespace codesign {
Scaling::Scaling(const Study& study) : study_(study), start_(to_signed(study.tuned.size())) {
  for (std::size_t k = 0; k < study.tuned.size(); ++k) {
    const Parameter& p = study.parameters[to_index(study.tuned[k])];
    start_[to_signed(k)] = p.value;
    origin_.push_back(has_range(p) ? p.lower : 0.0);
    range_.push_back(extent(p, 0.0));
    lower_.push_back((p.lower - origin_[k]) / range_[k]);
    upper_.push_back((p.upper - origin_[k]) / range_[k]);
  }
}

bool Scaling::reach(std::size_t k, double rho, double reach) {
  const Parameter& p = study_.parameters[to_index(study_.tuned[k])];
  if (has_range(p)) return false;
  const double size = extent(p, rho), before = range_[k];
  const bool has_size = p.value != 0.0 || !(reach > 0.0);
  const double least = has_size ? size : std::max(std::abs(rho), 1.0 / kFarthest);
  range_[k] = std::min(kFarthest * size, std::max(least, reach));
  lower_[k] = p.lower / range_[k];
  upper_[k] = p.upper / range_[k];
  return range_[k] != before;
}

std::vector<double> Scaling::to_scaled(const Eigen::VectorXd& rho) const {
  std::vector<double> x(range_.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = (rho[to_signed(k)] - origin_[k]) / range_[k];
  return x;
}

Eigen::VectorXd Scaling::from_scaled(const std::vector<double>& x) const {
  Eigen::VectorXd rho(to_signed(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Parameter& p = study_.parameters[to_index(study_.tuned[k])];
    rho[to_signed(k)] = std::min(p.upper, std::max(p.lower, origin_[k] + range_[k] * x[k]));
  }
  return rho;
}

std::vector<double> Scaling::scale_gradient(const Eigen::VectorXd& gradient) const {
  std::vector<double> scaled(range_.size());
  for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] = gradient[to_signed(k)] * range_[k];
  return scaled;
}

double Scaling::gradient_norm(const Eigen::VectorXd& gradient) const {
  double sum = 0.0;
  for (double component : scale_gradient(gradient)) sum += component * component;
  return std::sqrt(sum);
}

double Scaling::free_gradient_norm(const Eigen::VectorXd& rho,
                                   const Eigen::VectorXd& gradient) const {
  constexpr double kOnBound = 1e-9;
  const std::vector<double> x = to_scaled(rho);
  Eigen::VectorXd free = gradient;
  for (std::size_t k = 0; k < x.size(); ++k) {
    double& component = free[to_signed(k)];
    if ((x[k] - lower_[k] <= kOnBound && component > 0.0) ||
        (upper_[k] - x[k] <= kOnBound && component < 0.0))
      component = 0.0;
  }
  return gradient_norm(free);
}

double Scaling::square_distance(const Eigen::VectorXd& rho, const std::vector<double>& x,
                                double weight, std::vector<double>* gradient) const {
  const std::vector<double> from = to_scaled(rho);
  double distance = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const double d = x[k] - from[k];
    distance += d * d;
    if (!gradient->empty()) (*gradient)[k] = 2.0 * weight * d;
  }
  return distance;
}

}  // namespace codesign
