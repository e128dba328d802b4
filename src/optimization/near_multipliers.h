// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <utility>
#include <vector>

#include "math/arrays.h"

namespace codesign {

/// A row or bound with a multiplier c: the residual contains c times its direction a, and c times
/// its distance d from being active.
struct Holder {
  Eigen::VectorXd leading;  ///< a by the first variables, which most rows read; empty: zero
  /// the other entries of a that are not zero, by variable, ascending
  std::vector<std::pair<Eigen::Index, double>> others;
  double distance = 0.0;  ///< d, 0 or more
  bool any_sign = false;  ///< an equality, d = 0: the multiplier may be negative
  bool is_bound = false;  ///< of the variable others[0], with the entry 1 or -1
  bool is_on_bound() const { return is_bound && distance == 0.0; }
};

/// The multipliers c that minimize
///   s^2 = |g - sum_k c_k a_k|^2 + sum_k (c_k d_k)^2    over c_k >= 0, of any sign for equalities,
/// the sum of squares of doc/theory.md (24j). Rows are many, variables few. A row that is not near,
/// d_k > 1e-6 |a_k|, has at the minimum
///   c_k = max(0, a_k^T r) / d_k^2,    r = g - sum_k c_k a_k,
/// so these rows enter by a matrix of the variables, I + sum_k a_k a_k^T / d_k^2 over those with
/// a_k^T r > 0, whose set Newton's method finds. Only near rows, where this quotient is lost in
/// rounding, have multipliers of their own, by the active set of Lawson and Hanson.
struct Multipliers {
  Eigen::VectorXd values;  ///< c, one per holder
  Eigen::VectorXd rest;    ///< r
  double residual = 0.0;   ///< s
  std::vector<bool> near;  ///< by holder: whether it is near
  int factorizations = 0;  ///< of matrices of the variables
};

/// @param holders with directions of numbers. @param cancel ends the iteration, may be null: the
/// multipliers then have their signs, but do not minimize.
Multipliers least_multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
                              const std::atomic<bool>* cancel);

/// Holders that are not near, by their directions over their distances: w = a / d. Rows that read
/// the same variables form a group, so that time and memory are those of the variables that a row
/// reads.
class FarRows {
 public:
  /// @param holders must outlive this. @param far indices in `holders`. @param distances positive,
  /// one per row.
  FarRows(Eigen::Index variables, const std::vector<Holder>& holders, std::vector<std::size_t> far,
          Eigen::VectorXd distances);

  std::size_t size() const { return far_.size(); }
  std::size_t holder(std::size_t row) const { return far_[row]; }
  double distance(std::size_t row) const { return distances_[to_signed(row)]; }

  /// w^T x of each row.
  Eigen::VectorXd along(const Eigen::VectorXd& x) const;
  /// sum_k p_k w_k, p one number per row.
  Eigen::VectorXd sum(const Eigen::VectorXd& p) const;
  /// Rows M with M^T M = I + sum_k w_k w_k^T over the active rows.
  Eigen::MatrixXd metric(const std::vector<bool>& active) const;

 private:
  void append(const std::vector<Eigen::Index>& group, const std::vector<bool>& active,
              Eigen::MatrixXd* rows) const;

  const Eigen::Index variables_;
  const std::vector<Holder>& holders_;
  const std::vector<std::size_t> far_;
  const Eigen::VectorXd distances_;
  Eigen::MatrixXd leading_;  ///< leading entries of w, one column per row
  /// rows that read the same variables, without bounds
  std::vector<std::vector<Eigen::Index>> groups_;
};

/// The multipliers c of rows and bounds that are near. With the rows M of a metric they minimize
///   h^T (M^T M)^-1 h + sum_k (c_k d_k)^2,    h = g - sum_k c_k a_k,
/// over c of their signs, by the active set of Lawson and Hanson. The multiplier of a variable on
/// its bound takes the whole component of that variable, so that variable is eliminated, and the
/// multiplier not solved for.
class NearMultipliers {
 public:
  /// All arguments must outlive this. @param near indices in `holders`. @param cancel may be null.
  NearMultipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
                  const std::vector<std::size_t>& near, const std::atomic<bool>* cancel);

  /// Minimizes, from the multipliers of the call before.
  void minimize(const Eigen::MatrixXd& metric);
  /// c, one per near holder.
  const Eigen::VectorXd& values() const { return c_; }
  /// (M^T M)^-1 h.
  const Eigen::VectorXd& rest() const { return rest_; }
  /// sum_k c_k a_k.
  Eigen::VectorXd held() const { return directions_ * c_; }
  /// sum_k (c_k d_k)^2.
  double products() const { return c_.cwiseProduct(distances_).squaredNorm(); }
  /// (M^T M)^-1 x by the variables that are not held by a bound; zero for the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& x) const;
  /// Sets the multipliers of held variables so that these have no part in x - held(), as far as
  /// their signs permit.
  void balance_bounds(const Eigen::VectorXd& x);
  int factorizations() const { return factorizations_; }

 private:
  bool add_best();
  void move_to_targets(const Eigen::MatrixXd& metric);
  void factor(const Eigen::MatrixXd& metric);
  Eigen::VectorXd target(const Eigen::MatrixXd& metric);
  bool may_block(Eigen::Index k) const;
  const Holder& holder(Eigen::Index k) const { return holders_[near_[to_index(k)]]; }

  const Eigen::VectorXd& gradient_;
  const std::vector<Holder>& holders_;
  const std::vector<std::size_t>& near_;
  const std::atomic<bool>* cancel_;
  Eigen::MatrixXd directions_;  ///< a, one column per near holder
  Eigen::VectorXd distances_, c_, rest_;
  std::vector<bool> used_;
  std::vector<int> free_;   ///< variables that no bound holds
  Eigen::MatrixXd factor_;  ///< R of these columns of M
  int factorizations_ = 0;
};

}  // namespace codesign
