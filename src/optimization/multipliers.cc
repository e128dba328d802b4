// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/multipliers.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/near_multipliers.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kNear = 1e-6;        // of the length of a direction
constexpr Index kMostNear = 10;       // near inequalities per variable; more count as kNear away
constexpr int kMostRounds = 100;      // of Newton's method, which takes about ten
constexpr int kMostHalvings = 30;     // of its steps
constexpr int kRefinements = 2;       // of the multipliers of far rows: each reduces their error by the rounding of r over kNear squared
constexpr double kLeastShare = 1e-4;  // of the slope that a step must gain
constexpr double kRoundingOfValue = 1e-24;  // of |g|^2

double length_of(const Holder& holder) {
  double sum = holder.leading.squaredNorm();
  for (const auto& [variable, entry] : holder.others) sum += entry * entry;
  return std::sqrt(sum);
}

/// Near and far holders; a row without a direction is neither.
struct Places {
  std::vector<std::size_t> near, far;
  std::vector<double> far_distances;
};

Places places_of(const std::vector<Holder>& holders, Index variables) {
  Places places;
  std::vector<std::pair<double, std::size_t>> close;
  const auto add_far = [&places](std::size_t k, double distance) {
    places.far.push_back(k);
    places.far_distances.push_back(distance);
  };
  for (std::size_t k = 0; k < holders.size(); ++k) {
    const double length = length_of(holders[k]);
    if (!(length > 0.0)) continue;
    if (holders[k].any_sign || holders[k].is_on_bound())
      places.near.push_back(k);
    else if (holders[k].distance <= kNear * length)
      close.emplace_back(holders[k].distance / length, k);
    else
      add_far(k, holders[k].distance);
  }
  std::sort(close.begin(), close.end());
  for (std::size_t i = 0; i < close.size(); ++i)
    if (const std::size_t k = close[i].second; i < static_cast<std::size_t>(kMostNear * variables))
      places.near.push_back(k);
    else
      add_far(k, kNear * length_of(holders[k]));
  return places;
}

/// Newton's method for the sum of squares as a function of r,
///   F(r) = r^T r - 2 g^T r + sum over far rows of max(0, w_k^T r)^2 + that of near rows,
/// which is convex and, but for near rows, quadratic between the planes w_k^T r = 0. Its minimum is -s^2.
class NewtonSearch {
 public:
  NewtonSearch(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders, const std::atomic<bool>* cancel)
      : NewtonSearch(gradient, holders, places_of(holders, gradient.size()), cancel) {}

  Multipliers run() {
    std::vector<bool> active(far_.size(), false);
    near_.minimize(far_.metric(active));
    r_ = near_.rest();
    along_ = far_.along(r_);
    products_ = near_.products();
    for (int round = 0; round < kMostRounds && !is_cancelled(); ++round) {
      std::vector<bool> now(far_.size());
      for (std::size_t k = 0; k < now.size(); ++k) now[k] = along_[static_cast<Index>(k)] > 0.0;
      if (now == active && is_full_) break;
      active = std::move(now);
      near_.minimize(far_.metric(active));
      if (!step()) break;
    }
    refine(active);
    return multipliers();
  }

 private:
  NewtonSearch(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders, const Places& places, const std::atomic<bool>* cancel)
      : gradient_(gradient),
        holders_(holders),
        cancel_(cancel),
        nearest_(places.near),
        far_(gradient.size(), holders, places.far,
             Eigen::Map<const Eigen::VectorXd>(places.far_distances.data(), static_cast<Index>(places.far_distances.size()))),
        near_(gradient, holders, nearest_, cancel) {}

  bool is_cancelled() const { return cancel_ && *cancel_; }

  static double square(const Eigen::VectorXd& along) { return along.cwiseMax(0.0).squaredNorm(); }

  /// Goes towards the minimum for the active rows as far as F falls. False at the minimum.
  bool step() {
    const Eigen::VectorXd p = near_.rest() - r_, change = far_.along(near_.rest()) - along_;
    const double near_change = near_.products() - products_;
    const auto value = [&](double t) {
      return t * (p.dot(2.0 * (r_ - gradient_) + t * p) + near_change) + square(along_ + t * change) - square(along_);
    };
    const double slope = 2.0 * (p.dot(r_ - gradient_) + along_.cwiseMax(0.0).dot(change)) + near_change;
    if (!(slope < -kRoundingOfValue * gradient_.squaredNorm())) return false;
    double t = 1.0;
    for (int k = 0; k < kMostHalvings && !(value(t) <= kLeastShare * t * slope); ++k) t *= 0.5;
    is_full_ = t == 1.0;
    r_ += t * p;
    along_ += t * change;
    products_ += t * near_change;
    return true;
  }

  /// The multipliers of far rows for the r of near ones, and their rounding corrected by the r that they leave.
  void refine(const std::vector<bool>& active) {
    r_ = near_.rest();
    rest_ = gradient_ - near_.held();
    weights_.setZero(static_cast<Index>(far_.size()));
    if (near_.factorizations() == 0) return;
    for (int k = 0; k <= kRefinements; ++k) {
      const Eigen::VectorXd along = far_.along(r_);
      for (std::size_t i = 0; i < active.size(); ++i)
        if (const auto row = static_cast<Index>(i); active[i]) weights_[row] = std::max(0.0, weights_[row] + along[row]);
      const Eigen::VectorXd without_near = gradient_ - far_.sum(weights_);
      near_.balance_bounds(without_near);
      rest_ = without_near - near_.held();
      // What r should be, less what it is.
      total_ = k == 0 ? r_ : Eigen::VectorXd(total_ + r_);
      r_ = near_.solve(rest_ - total_);
    }
  }

  Multipliers multipliers() const {
    Multipliers result;
    result.values.setZero(static_cast<Index>(holders_.size()));
    result.near.assign(holders_.size(), false);
    for (std::size_t k = 0; k < nearest_.size(); ++k) {
      result.values[static_cast<Index>(nearest_[k])] = near_.values()[static_cast<Index>(k)];
      result.near[nearest_[k]] = true;
    }
    for (std::size_t k = 0; k < far_.size(); ++k)
      result.values[static_cast<Index>(far_.holder(k))] = weights_[static_cast<Index>(k)] / far_.distance(k);
    result.rest = rest_;
    double sum = rest_.squaredNorm();
    for (std::size_t k = 0; k < holders_.size(); ++k) sum += std::pow(result.values[static_cast<Index>(k)] * holders_[k].distance, 2);
    result.residual = std::sqrt(sum);
    result.factorizations = near_.factorizations();
    return result;
  }

  const Eigen::VectorXd& gradient_;
  const std::vector<Holder>& holders_;
  const std::atomic<bool>* cancel_;
  const std::vector<std::size_t> nearest_;
  const FarRows far_;
  NearMultipliers near_;
  Eigen::VectorXd r_, along_, rest_, total_;
  Eigen::VectorXd weights_;  ///< c d of far rows
  double products_ = 0.0;
  bool is_full_ = true;  ///< whether r_ is the minimum for the active rows
};

}  // namespace

Multipliers least_multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders, const std::atomic<bool>* cancel) {
  return NewtonSearch(gradient, holders, cancel).run();
}

}  // namespace codesign
