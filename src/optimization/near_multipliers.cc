// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/near_multipliers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/arrays.h"
#include "math/dense.h"

namespace codesign {
namespace {

using Eigen::Index;
constexpr double kNear = 1e-6;     // of the length of a direction
constexpr Index kMostNear = 10;    // near inequalities per variable; more count as kNear away
constexpr int kMostRounds = 100;   // of Newton's method, which takes about ten
constexpr int kMostHalvings = 30;  // of its steps
// Refinements of the multipliers of far rows, which each reduce their error by the rounding of r
// over kNear squared.
constexpr int kRefinements = 2;
constexpr double kLeastShare = 1e-4;        // of the slope that a step must gain
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
    if (const std::size_t k = close[i].second; i < to_index(kMostNear * variables))
      places.near.push_back(k);
    else
      add_far(k, kNear * length_of(holders[k]));
  return places;
}

/// Newton's method for the sum of squares as a function of r,
///   F(r) = r^T r - 2 g^T r + sum over far rows of max(0, w_k^T r)^2 + that of near rows,
/// which is convex and, but for near rows, quadratic between the planes w_k^T r = 0. Its minimum is
/// -s^2.
class NewtonSearch {
 public:
  NewtonSearch(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
               const std::atomic<bool>* cancel)
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
  NewtonSearch(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
               const Places& places, const std::atomic<bool>* cancel)
      : gradient_(gradient),
        holders_(holders),
        cancel_(cancel),
        nearest_(places.near),
        far_(gradient.size(), holders, places.far,
             Eigen::Map<const Eigen::VectorXd>(places.far_distances.data(),
                                               static_cast<Index>(places.far_distances.size()))),
        near_(gradient, holders, nearest_, cancel) {}

  bool is_cancelled() const { return cancel_ && *cancel_; }

  static double square(const Eigen::VectorXd& along) { return along.cwiseMax(0.0).squaredNorm(); }

  /// Goes towards the minimum for the active rows as far as F falls. False at the minimum.
  bool step() {
    const Eigen::VectorXd p = near_.rest() - r_, change = far_.along(near_.rest()) - along_;
    const double near_change = near_.products() - products_;
    const auto value = [&](double t) {
      return t * (p.dot(2.0 * (r_ - gradient_) + t * p) + near_change) +
             square(along_ + t * change) - square(along_);
    };
    const double slope =
        2.0 * (p.dot(r_ - gradient_) + along_.cwiseMax(0.0).dot(change)) + near_change;
    if (!(slope < -kRoundingOfValue * gradient_.squaredNorm())) return false;
    double t = 1.0;
    for (int k = 0; k < kMostHalvings && !(value(t) <= kLeastShare * t * slope); ++k) t *= 0.5;
    is_full_ = t == 1.0;
    r_ += t * p;
    along_ += t * change;
    products_ += t * near_change;
    return true;
  }

  /// The multipliers of far rows for the r of near ones, and their rounding corrected by the r that
  /// they leave.
  void refine(const std::vector<bool>& active) {
    r_ = near_.rest();
    rest_ = gradient_ - near_.held();
    weights_.setZero(static_cast<Index>(far_.size()));
    if (near_.factorizations() == 0) return;
    for (int k = 0; k <= kRefinements; ++k) {
      const Eigen::VectorXd along = far_.along(r_);
      for (std::size_t i = 0; i < active.size(); ++i)
        if (const auto row = static_cast<Index>(i); active[i])
          weights_[row] = std::max(0.0, weights_[row] + along[row]);
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
      result.values[static_cast<Index>(far_.holder(k))] =
          weights_[static_cast<Index>(k)] / far_.distance(k);
    result.rest = rest_;
    double sum = rest_.squaredNorm();
    for (std::size_t k = 0; k < holders_.size(); ++k)
      sum += std::pow(result.values[static_cast<Index>(k)] * holders_[k].distance, 2);
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

using Eigen::Index;
// A multiplier that would reduce the residual by less is left out.
constexpr double kNoGain = 1e-12;

}  // namespace

Multipliers least_multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
                              const std::atomic<bool>* cancel) {
  return NewtonSearch(gradient, holders, cancel).run();
}

using Eigen::Index;
FarRows::FarRows(Index variables, const std::vector<Holder>& holders, std::vector<std::size_t> far,
                 Eigen::VectorXd distances)
    : variables_(variables),
      holders_(holders),
      far_(std::move(far)),
      distances_(std::move(distances)) {
  Index leading = 0;
  for (const std::size_t k : far_) leading = std::max(leading, holders_[k].leading.size());
  leading_.setZero(leading, distances_.size());
  std::map<std::vector<Index>, std::size_t> group_of;
  for (Index row = 0; row < distances_.size(); ++row) {
    const Holder& holder = holders_[far_[to_index(row)]];
    if (holder.leading.size() > 0) leading_.col(row) = holder.leading / distances_[row];
    if (holder.is_bound) continue;
    std::vector<Index> pattern;
    for (const auto& other : holder.others) pattern.push_back(other.first);
    const auto [place, is_new] = group_of.try_emplace(std::move(pattern), groups_.size());
    if (is_new) groups_.emplace_back();
    groups_[place->second].push_back(row);
  }
}

Eigen::VectorXd FarRows::along(const Eigen::VectorXd& x) const {
  Eigen::VectorXd products = leading_.transpose() * x.head(leading_.rows());
  for (Index row = 0; row < products.size(); ++row)
    for (const auto& [variable, entry] : holders_[far_[to_index(row)]].others)
      products[row] += entry / distances_[row] * x[variable];
  return products;
}

Eigen::VectorXd FarRows::sum(const Eigen::VectorXd& p) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables_);
  x.head(leading_.rows()) = leading_ * p;
  for (Index row = 0; row < p.size(); ++row) {
    if (p[row] == 0.0) continue;
    for (const auto& [variable, entry] : holders_[far_[to_index(row)]].others)
      x[variable] += entry / distances_[row] * p[row];
  }
  return x;
}

Eigen::MatrixXd FarRows::metric(const std::vector<bool>& active) const {
  Eigen::VectorXd squares = Eigen::VectorXd::Ones(variables_);
  for (std::size_t k = 0; k < far_.size(); ++k)
    if (active[k] && holders_[far_[k]].is_bound)
      squares[holders_[far_[k]].others[0].first] += std::pow(distance(k), -2);
  Eigen::MatrixXd rows = squares.cwiseSqrt().asDiagonal();
  for (const std::vector<Index>& group : groups_) append(group, active, &rows);
  return rows;
}

/// Appends the active rows of a group, as a triangle if they are more than the variables that they
/// read.
void FarRows::append(const std::vector<Index>& group, const std::vector<bool>& active,
                     Eigen::MatrixXd* rows) const {
  std::vector<Index> chosen;
  for (const Index row : group)
    if (active[to_index(row)]) chosen.push_back(row);
  if (chosen.empty()) return;
  const auto others_of = [&](Index row) -> const auto& {
    return holders_[far_[to_index(row)]].others;
  };
  const auto& pattern = others_of(chosen[0]);
  const Index leading = leading_.rows(), columns = leading + static_cast<Index>(pattern.size());
  Eigen::MatrixXd block(static_cast<Index>(chosen.size()), columns);
  for (Index k = 0; k < block.rows(); ++k) {
    const Index row = chosen[to_index(k)];
    block.row(k).head(leading) = leading_.col(row).transpose();
    for (std::size_t i = 0; i < pattern.size(); ++i)
      block(k, leading + static_cast<Index>(i)) = others_of(row)[i].second / distances_[row];
  }
  if (block.rows() > columns) block = upper_factor(block);
  rows->conservativeResize(rows->rows() + block.rows(), Eigen::NoChange);
  auto added = rows->bottomRows(block.rows());
  added.setZero();
  added.leftCols(leading) = block.leftCols(leading);
  for (std::size_t i = 0; i < pattern.size(); ++i)
    added.col(pattern[i].first) = block.col(leading + static_cast<Index>(i));
}

NearMultipliers::NearMultipliers(const Eigen::VectorXd& gradient,
                                 const std::vector<Holder>& holders,
                                 const std::vector<std::size_t>& near,
                                 const std::atomic<bool>* cancel)
    : gradient_(gradient), holders_(holders), near_(near), cancel_(cancel), rest_(gradient) {
  const auto count = static_cast<Index>(near_.size());
  directions_.setZero(gradient_.size(), count);
  distances_.resize(count);
  c_.setZero(count);
  used_.resize(near_.size());
  for (Index k = 0; k < count; ++k) {
    const Holder& one = holder(k);
    directions_.col(k).head(one.leading.size()) = one.leading;
    for (const auto& [variable, entry] : one.others) directions_(variable, k) = entry;
    distances_[k] = one.distance;
    used_[to_index(k)] =
        one.any_sign || (one.is_on_bound() && directions_.col(k).dot(gradient_) > 0.0);
  }
}

void NearMultipliers::minimize(const Eigen::MatrixXd& metric) {
  free_.clear();
  factor_.resize(0, 0);
  move_to_targets(metric);
  for (std::size_t round = 0; round < 3 * near_.size() && add_best(); ++round)
    move_to_targets(metric);
}

Eigen::VectorXd NearMultipliers::solve(const Eigen::VectorXd& x) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size()), part = x(free_);
  factor_.triangularView<Eigen::Upper>().transpose().solveInPlace(part);
  factor_.triangularView<Eigen::Upper>().solveInPlace(part);
  result(free_) = part;
  return result;
}

void NearMultipliers::balance_bounds(const Eigen::VectorXd& x) {
  const Eigen::VectorXd rest = x - held();
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[to_index(k)] && holder(k).is_on_bound())
      c_[k] = std::max(0.0, c_[k] + directions_.col(k).dot(rest));
}

/// Adds the unused multiplier that reduces the residual fastest. False if there is none.
bool NearMultipliers::add_best() {
  if (cancel_ && *cancel_) return false;
  double most = kNoGain * gradient_.norm();
  Index best = -1;
  const Eigen::VectorXd gains = directions_.transpose() * rest_;
  for (Index k = 0; k < gains.size(); ++k) {
    if (used_[to_index(k)]) continue;
    const double gain = gains[k] / directions_.col(k).norm();
    if (!(gain > most)) continue;
    most = gain;
    best = k;
  }
  if (best < 0) return false;
  used_[to_index(best)] = true;
  return true;
}

/// Moves the used multipliers towards their least-squares values, dropping those that reach zero on
/// the way.
void NearMultipliers::move_to_targets(const Eigen::MatrixXd& metric) {
  for (std::size_t round = 0; round <= near_.size(); ++round) {
    const Eigen::VectorXd target = this->target(metric);
    double fraction = 1.0;
    for (Index k = 0; k < c_.size(); ++k)
      if (may_block(k) && target[k] < 0.0)
        fraction = std::min(fraction, c_[k] / (c_[k] - target[k]));
    c_ += fraction * (target - c_);
    bool dropped = false;
    for (Index k = 0; k < c_.size(); ++k) {
      if (!may_block(k) || !(target[k] < 0.0) || c_[k] > kNoGain * (1.0 + std::abs(target[k])))
        continue;
      c_[k] = 0.0;
      used_[to_index(k)] = false;
      dropped = true;
    }
    if (!dropped) return;
  }
}

bool NearMultipliers::may_block(Index k) const { return used_[to_index(k)] && !holder(k).any_sign; }

/// Decomposes the columns of the free variables, if they have changed.
void NearMultipliers::factor(const Eigen::MatrixXd& metric) {
  std::vector<bool> held(to_index(gradient_.size()), false);
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[to_index(k)] && holder(k).is_on_bound())
      held[to_index(holder(k).others[0].first)] = true;
  std::vector<int> free;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) free.push_back(static_cast<int>(i));
  if (free == free_ && factor_.size() > 0) return;
  free_ = std::move(free);
  factor_ = upper_factor(metric(Eigen::all, free_));
  ++factorizations_;
}

/// The least-squares values of the used multipliers, and 0 for the others. Sets rest_ to theirs.
Eigen::VectorXd NearMultipliers::target(const Eigen::MatrixXd& metric) {
  factor(metric);
  std::vector<Index> columns;
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[to_index(k)] && !holder(k).is_on_bound()) columns.push_back(k);
  const auto size = static_cast<Index>(free_.size()), count = static_cast<Index>(columns.size());
  Eigen::VectorXd target = Eigen::VectorXd::Zero(c_.size());
  if (count > 0) {
    Eigen::MatrixXd top(size, count + 1);
    top << directions_(free_, columns), gradient_(free_);
    factor_.triangularView<Eigen::Upper>().transpose().solveInPlace(top);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size + count, count),
                    right = Eigen::MatrixXd::Zero(size + count, 1);
    A.topRows(size) = top.leftCols(count);
    A.bottomRows(count) = Eigen::VectorXd(distances_(columns)).asDiagonal();
    right.topRows(size) = top.rightCols(1);
    target(columns) = least_norm(A).solve(right).col(0);
  }
  const Eigen::VectorXd left = gradient_ - directions_ * target;
  rest_ = solve(left);
  const Eigen::VectorXd missing = left - metric.transpose() * (metric * rest_);
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[to_index(k)] && holder(k).is_on_bound()) target[k] = directions_.col(k).dot(missing);
  return target;
}

}  // namespace codesign
