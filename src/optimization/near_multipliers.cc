// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/near_multipliers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/dense.h"

namespace codesign {
namespace {

using Eigen::Index;

constexpr double kNoGain = 1e-12;  // a multiplier that would reduce the residual by less is left out

}  // namespace

using Eigen::Index;

FarRows::FarRows(Index variables, const std::vector<Holder>& holders, std::vector<std::size_t> far, Eigen::VectorXd distances)
    : variables_(variables), holders_(holders), far_(std::move(far)), distances_(std::move(distances)) {
  Index leading = 0;
  for (const std::size_t k : far_) leading = std::max(leading, holders_[k].leading.size());
  leading_.setZero(leading, distances_.size());
  std::map<std::vector<Index>, std::size_t> group_of;
  for (Index row = 0; row < distances_.size(); ++row) {
    const Holder& holder = holders_[far_[static_cast<std::size_t>(row)]];
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
    for (const auto& [variable, entry] : holders_[far_[static_cast<std::size_t>(row)]].others)
      products[row] += entry / distances_[row] * x[variable];
  return products;
}

Eigen::VectorXd FarRows::sum(const Eigen::VectorXd& p) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(variables_);
  x.head(leading_.rows()) = leading_ * p;
  for (Index row = 0; row < p.size(); ++row) {
    if (p[row] == 0.0) continue;
    for (const auto& [variable, entry] : holders_[far_[static_cast<std::size_t>(row)]].others)
      x[variable] += entry / distances_[row] * p[row];
  }
  return x;
}

Eigen::MatrixXd FarRows::metric(const std::vector<bool>& active) const {
  Eigen::VectorXd squares = Eigen::VectorXd::Ones(variables_);
  for (std::size_t k = 0; k < far_.size(); ++k)
    if (active[k] && holders_[far_[k]].is_bound) squares[holders_[far_[k]].others[0].first] += std::pow(distance(k), -2);
  Eigen::MatrixXd rows = squares.cwiseSqrt().asDiagonal();
  for (const std::vector<Index>& group : groups_) append(group, active, &rows);
  return rows;
}

/// Appends the active rows of a group, as a triangle if they are more than the variables that they read.
void FarRows::append(const std::vector<Index>& group, const std::vector<bool>& active, Eigen::MatrixXd* rows) const {
  std::vector<Index> chosen;
  for (const Index row : group)
    if (active[static_cast<std::size_t>(row)]) chosen.push_back(row);
  if (chosen.empty()) return;
  const auto others_of = [&](Index row) -> const auto& { return holders_[far_[static_cast<std::size_t>(row)]].others; };
  const auto& pattern = others_of(chosen[0]);
  const Index leading = leading_.rows(), columns = leading + static_cast<Index>(pattern.size());
  Eigen::MatrixXd block(static_cast<Index>(chosen.size()), columns);
  for (Index k = 0; k < block.rows(); ++k) {
    const Index row = chosen[static_cast<std::size_t>(k)];
    block.row(k).head(leading) = leading_.col(row).transpose();
    for (std::size_t i = 0; i < pattern.size(); ++i) block(k, leading + static_cast<Index>(i)) = others_of(row)[i].second / distances_[row];
  }
  if (block.rows() > columns) block = upper_factor(block);
  rows->conservativeResize(rows->rows() + block.rows(), Eigen::NoChange);
  auto added = rows->bottomRows(block.rows());
  added.setZero();
  added.leftCols(leading) = block.leftCols(leading);
  for (std::size_t i = 0; i < pattern.size(); ++i) added.col(pattern[i].first) = block.col(leading + static_cast<Index>(i));
}

NearMultipliers::NearMultipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders, const std::vector<std::size_t>& near,
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
    used_[static_cast<std::size_t>(k)] = one.any_sign || (one.is_on_bound() && directions_.col(k).dot(gradient_) > 0.0);
  }
}

void NearMultipliers::minimize(const Eigen::MatrixXd& metric) {
  free_.clear();
  factor_.resize(0, 0);
  settle(metric);
  for (std::size_t round = 0; round < 3 * near_.size() && add_best(); ++round) settle(metric);
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
    if (used_[static_cast<std::size_t>(k)] && holder(k).is_on_bound()) c_[k] = std::max(0.0, c_[k] + directions_.col(k).dot(rest));
}

/// Adds the unused multiplier that reduces the residual fastest. False if there is none.
bool NearMultipliers::add_best() {
  if (cancel_ && *cancel_) return false;
  double most = kNoGain * gradient_.norm();
  Index best = -1;
  const Eigen::VectorXd gains = directions_.transpose() * rest_;
  for (Index k = 0; k < gains.size(); ++k) {
    if (used_[static_cast<std::size_t>(k)]) continue;
    const double gain = gains[k] / directions_.col(k).norm();
    if (!(gain > most)) continue;
    most = gain;
    best = k;
  }
  if (best < 0) return false;
  used_[static_cast<std::size_t>(best)] = true;
  return true;
}

/// Moves the used multipliers towards their least-squares values, dropping those that reach zero on the way.
void NearMultipliers::settle(const Eigen::MatrixXd& metric) {
  for (std::size_t round = 0; round <= near_.size(); ++round) {
    const Eigen::VectorXd target = this->target(metric);
    double fraction = 1.0;
    for (Index k = 0; k < c_.size(); ++k)
      if (may_block(k) && target[k] < 0.0) fraction = std::min(fraction, c_[k] / (c_[k] - target[k]));
    c_ += fraction * (target - c_);
    bool dropped = false;
    for (Index k = 0; k < c_.size(); ++k) {
      if (!may_block(k) || !(target[k] < 0.0) || c_[k] > kNoGain * (1.0 + std::abs(target[k]))) continue;
      c_[k] = 0.0;
      used_[static_cast<std::size_t>(k)] = false;
      dropped = true;
    }
    if (!dropped) return;
  }
}

bool NearMultipliers::may_block(Index k) const { return used_[static_cast<std::size_t>(k)] && !holder(k).any_sign; }

/// Decomposes the columns of the free variables, if they have changed.
void NearMultipliers::factor(const Eigen::MatrixXd& metric) {
  std::vector<bool> held(static_cast<std::size_t>(gradient_.size()), false);
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[static_cast<std::size_t>(k)] && holder(k).is_on_bound()) held[static_cast<std::size_t>(holder(k).others[0].first)] = true;
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
    if (used_[static_cast<std::size_t>(k)] && !holder(k).is_on_bound()) columns.push_back(k);
  const auto size = static_cast<Index>(free_.size()), count = static_cast<Index>(columns.size());
  Eigen::VectorXd target = Eigen::VectorXd::Zero(c_.size());
  if (count > 0) {
    Eigen::MatrixXd top(size, count + 1);
    top << directions_(free_, columns), gradient_(free_);
    factor_.triangularView<Eigen::Upper>().transpose().solveInPlace(top);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size + count, count), right = Eigen::MatrixXd::Zero(size + count, 1);
    A.topRows(size) = top.leftCols(count);
    A.bottomRows(count) = Eigen::VectorXd(distances_(columns)).asDiagonal();
    right.topRows(size) = top.rightCols(1);
    target(columns) = least_norm(A).solve(right).col(0);
  }
  const Eigen::VectorXd left = gradient_ - directions_ * target;
  rest_ = solve(left);
  const Eigen::VectorXd missing = left - metric.transpose() * (metric * rest_);
  for (Index k = 0; k < c_.size(); ++k)
    if (used_[static_cast<std::size_t>(k)] && holder(k).is_on_bound()) target[k] = directions_.col(k).dot(missing);
  return target;
}

}  // namespace codesign
