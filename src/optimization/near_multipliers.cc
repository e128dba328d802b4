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
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Least distances, in lengths of the directions. The first ones find the active rows in a few
// rounds, with the last one the rounding of r is worth four digits of a multiplier.
constexpr double kLeastDistances[] = {1e-2, 1e-4, 1e-6, 1e-6};
constexpr int kMostRounds = 100;          // of Newton's method, which takes about five
constexpr int kRefinements = 2;           // each reduces the rounding of the multipliers by 1e-4
constexpr double kSlopeRounding = 1e-20;  // of |g|^2, in slopes
constexpr double kWholeStep = 1e-12;

/// The directions of all holders, one after another. Rows that read the same variables form a
/// group, so that time and memory are those of the variables that a row reads.
class HolderDirections {
 public:
  HolderDirections(Index variables, const std::vector<Holder>& holders)
      : variables_(variables), holders_(holders) {
    Index leading = 0;
    for (const Holder& holder : holders) leading = std::max(leading, holder.leading.size());
    leading_.setZero(leading, to_signed(holders.size()));
    lengths_.resize(to_signed(holders.size()));
    std::map<std::vector<Index>, std::vector<Index>> groups;
    for (Index row = 0; row < lengths_.size(); ++row) {
      const Holder& one = holder(row);
      leading_.col(row).head(one.leading.size()) = one.leading;
      double square = one.leading.squaredNorm();
      std::vector<Index> pattern;
      for (const auto& [variable, entry] : one.others) {
        pattern.push_back(variable);
        square += entry * entry;
      }
      lengths_[row] = std::sqrt(square);
      if (!one.is_bound) groups[std::move(pattern)].push_back(row);
    }
    for (auto& [pattern, rows] : groups) groups_.push_back(std::move(rows));
  }

  /// |a| of each row.
  const VectorXd& lengths() const { return lengths_; }
  /// a^T x of each row.
  VectorXd along(const VectorXd& x) const {
    VectorXd products = leading_.transpose() * x.head(leading_.rows());
    for (Index row = 0; row < products.size(); ++row)
      for (const auto& [variable, entry] : holder(row).others) products[row] += entry * x[variable];
    return products;
  }
  /// sum_k c_k a_k.
  VectorXd sum(const VectorXd& c) const {
    VectorXd x = VectorXd::Zero(variables_);
    x.head(leading_.rows()) = leading_ * c;
    for (Index row = 0; row < c.size(); ++row)
      for (const auto& [variable, entry] : holder(row).others) x[variable] += entry * c[row];
    return x;
  }
  /// R with R^T R = I + sum_k a_k a_k^T / D_k^2 over the active rows.
  MatrixXd factor(const VectorXd& distances, const std::vector<bool>& active) const {
    VectorXd squares = VectorXd::Ones(variables_);
    for (Index row = 0; row < distances.size(); ++row)
      if (active[to_index(row)] && holder(row).is_bound)
        squares[holder(row).others[0].first] += std::pow(distances[row], -2);
    MatrixXd rows = squares.cwiseSqrt().asDiagonal();
    for (const std::vector<Index>& group : groups_) append(group, distances, active, &rows);
    return upper_factor(rows);
  }

 private:
  const Holder& holder(Index row) const { return holders_[to_index(row)]; }

  /// Appends the active rows of a group, as a triangle if they are more than the variables that
  /// they read.
  void append(const std::vector<Index>& group, const VectorXd& distances,
              const std::vector<bool>& active, MatrixXd* rows) const {
    std::vector<Index> chosen;
    for (const Index row : group)
      if (active[to_index(row)]) chosen.push_back(row);
    if (chosen.empty()) return;
    const auto& pattern = holder(chosen[0]).others;
    const Index leading = leading_.rows(), columns = leading + to_signed(pattern.size());
    MatrixXd block(to_signed(chosen.size()), columns);
    for (Index k = 0; k < block.rows(); ++k) {
      const Index row = chosen[to_index(k)];
      block.row(k).head(leading) = leading_.col(row).transpose();
      for (std::size_t i = 0; i < pattern.size(); ++i)
        block(k, leading + to_signed(i)) = holder(row).others[i].second;
      block.row(k) /= distances[row];
    }
    if (block.rows() > columns) block = upper_factor(block);
    rows->conservativeResize(rows->rows() + block.rows(), Eigen::NoChange);
    auto added = rows->bottomRows(block.rows());
    added.setZero();
    added.leftCols(leading) = block.leftCols(leading);
    for (std::size_t i = 0; i < pattern.size(); ++i)
      added.col(pattern[i].first) = block.col(leading + to_signed(i));
  }

  const Index variables_;
  const std::vector<Holder>& holders_;
  MatrixXd leading_;  ///< leading entries of a, one column per row
  VectorXd lengths_;
  std::vector<std::vector<Index>> groups_;  ///< rows that read the same variables, without bounds
};

/// Newton's method with distances D of at least a share of the lengths. From multipliers c' it
/// minimizes s^2 + sum (D^2 - d^2)(c - c')^2, the minimum of which has
///   c D = max(0, a^T r / D + b),    b = (D^2 - d^2) c' / D.
class NewtonSearch {
 public:
  NewtonSearch(const VectorXd& gradient, const std::vector<Holder>& holders,
               const std::atomic<bool>* cancel)
      : gradient_(gradient),
        holders_(holders),
        cancel_(cancel),
        directions_(gradient.size(), holders),
        active_(holders.size()) {
    const auto count = to_signed(holders.size());
    own_.resize(count);
    for (Index k = 0; k < count; ++k) own_[k] = holders[to_index(k)].distance;
    best_.values.setZero(count);
    take(best_.values);
  }

  Multipliers run() {
    VectorXd c = best_.values;
    for (const double least : kLeastDistances) {
      // A row without a direction has no multiplier, whatever its distance.
      distances_ = own_.cwiseMax(least * directions_.lengths());
      distances_ = (distances_.array() > 0.0).select(distances_, 1.0);
      offsets_ =
          (distances_.cwiseAbs2() - own_.cwiseAbs2()).cwiseProduct(c).cwiseQuotient(distances_);
      set_active(c);
      move();
      if (is_cancelled()) break;
      c = refined();
      take(c);
    }
    best_.factorizations = factorizations_;
    return best_;
  }

 private:
  bool is_cancelled() const { return cancel_ && *cancel_; }
  bool is_free(Index k) const { return holders_[to_index(k)].any_sign; }

  void set_active(const VectorXd& signs) {
    for (Index k = 0; k < signs.size(); ++k)
      active_[to_index(k)] = signs[k] > 0.0 || (is_free(k) && directions_.lengths()[k] > 0.0);
    factor_ = directions_.factor(distances_, active_);
    ++factorizations_;
  }
  VectorXd of_active(const VectorXd& x) const {
    VectorXd part = x;
    for (Index k = 0; k < x.size(); ++k)
      if (!active_[to_index(k)]) part[k] = 0.0;
    return part;
  }
  VectorXd solve(VectorXd x) const {
    factor_.triangularView<Eigen::Upper>().transpose().solveInPlace(x);
    factor_.triangularView<Eigen::Upper>().solveInPlace(x);
    return x;
  }
  /// r for the active rows.
  VectorXd target() const {
    return solve(gradient_ - directions_.sum(of_active(offsets_).cwiseQuotient(distances_)));
  }

  void move() {
    VectorXd r = target();
    for (int round = 0; round < kMostRounds && !is_cancelled(); ++round) {
      const VectorXd along = directions_.along(r).cwiseQuotient(distances_) + offsets_;
      const std::vector<bool> before = active_;
      set_active(along);
      if (round > 0 && is_whole_ && before == active_) return;
      const VectorXd p = target() - r, change = directions_.along(p).cwiseQuotient(distances_);
      const double slope = p.dot(r - gradient_) + of_active(along).dot(change);
      if (!(slope < -kSlopeRounding * gradient_.squaredNorm())) return;
      const double step = least_along(along, change, slope, p.squaredNorm());
      is_whole_ = std::abs(step - 1.0) < kWholeStep;
      r += step * p;
    }
  }

  /// The minimum along a line, on which the slope is linear between the places where rows become
  /// active or inactive.
  double least_along(const VectorXd& along, const VectorXd& change, double slope,
                     double curvature) const {
    std::vector<std::pair<double, Index>> places;
    for (Index k = 0; k < along.size(); ++k) {
      if (active_[to_index(k)]) curvature += change[k] * change[k];
      if (const double t = -along[k] / change[k]; !is_free(k) && t > 0.0 && std::isfinite(t))
        places.emplace_back(t, k);
    }
    std::sort(places.begin(), places.end());
    double at = 0.0;
    for (const auto& [t, k] : places) {
      if (slope + curvature * (t - at) >= 0.0) break;
      slope += curvature * (t - at);
      at = t;
      curvature += std::copysign(change[k] * change[k], change[k]);
    }
    return at - slope / curvature;
  }

  /// The multipliers, and their rounding corrected by the r that they leave.
  VectorXd refined() const {
    VectorXd r = target(), total = VectorXd::Zero(r.size()), products = of_active(offsets_);
    for (int k = 0;; ++k) {
      products += of_active(directions_.along(r).cwiseQuotient(distances_));
      for (Index i = 0; i < products.size(); ++i)
        if (!is_free(i)) products[i] = std::max(0.0, products[i]);
      const VectorXd c = products.cwiseQuotient(distances_);
      if (k == kRefinements) return c;
      // What r should be, less what it is.
      total += r;
      r = solve(gradient_ - directions_.sum(c) - total);
    }
  }

  /// Keeps multipliers if their sum of squares is the least so far.
  void take(const VectorXd& c) {
    const VectorXd rest = gradient_ - directions_.sum(c);
    const double s = std::sqrt(rest.squaredNorm() + c.cwiseProduct(own_).squaredNorm());
    if (best_.rest.size() == 0 || s < best_.residual) best_ = {c, rest, s, 0};
  }

  const VectorXd& gradient_;
  const std::vector<Holder>& holders_;
  const std::atomic<bool>* cancel_;
  const HolderDirections directions_;
  VectorXd own_, distances_, offsets_;  ///< d, D, b
  std::vector<bool> active_;
  MatrixXd factor_;
  Multipliers best_;
  int factorizations_ = 0;
  bool is_whole_ = false;  ///< whether the last step went all the way
};

}  // namespace

Multipliers least_multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
                              const std::atomic<bool>* cancel) {
  return NewtonSearch(gradient, holders, cancel).run();
}

}  // namespace codesign
