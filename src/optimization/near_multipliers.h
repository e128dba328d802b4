// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "optimization/multipliers.h"

namespace codesign {

/// Holders that are not near, by their directions over their distances: w = a / d. Rows that read the same variables form a group, so that
/// time and memory are those of the variables that a row reads.
class FarRows {
 public:
  /// @param holders must outlive this. @param far indices in `holders`. @param distances positive, one per row.
  FarRows(Eigen::Index variables, const std::vector<Holder>& holders, std::vector<std::size_t> far, Eigen::VectorXd distances);

  std::size_t size() const { return far_.size(); }
  std::size_t holder(std::size_t row) const { return far_[row]; }
  double distance(std::size_t row) const { return distances_[static_cast<Eigen::Index>(row)]; }

  /// w^T x of each row.
  Eigen::VectorXd along(const Eigen::VectorXd& x) const;
  /// sum_k p_k w_k, p one number per row.
  Eigen::VectorXd sum(const Eigen::VectorXd& p) const;
  /// Rows M with M^T M = I + sum_k w_k w_k^T over the active rows.
  Eigen::MatrixXd metric(const std::vector<bool>& active) const;

 private:
  void append(const std::vector<Eigen::Index>& group, const std::vector<bool>& active, Eigen::MatrixXd* rows) const;

  const Eigen::Index variables_;
  const std::vector<Holder>& holders_;
  const std::vector<std::size_t> far_;
  const Eigen::VectorXd distances_;
  Eigen::MatrixXd leading_;                        ///< leading entries of w, one column per row
  std::vector<std::vector<Eigen::Index>> groups_;  ///< rows that read the same variables, without bounds
};

/// The multipliers c of rows and bounds that are near. With the rows M of a metric they minimize
///   h^T (M^T M)^-1 h + sum_k (c_k d_k)^2,    h = g - sum_k c_k a_k,
/// over c of their signs, by the active set of Lawson and Hanson. The multiplier of a variable on its bound takes the whole component of
/// that variable, so that variable is eliminated, and the multiplier not solved for.
class NearMultipliers {
 public:
  /// All arguments must outlive this. @param near indices in `holders`. @param cancel may be null.
  NearMultipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders, const std::vector<std::size_t>& near,
                  const std::atomic<bool>* cancel);

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
  /// Sets the multipliers of held variables so that these have no part in x - held(), as far as their signs permit.
  void balance_bounds(const Eigen::VectorXd& x);
  int factorizations() const { return factorizations_; }

 private:
  bool add_best();
  void settle(const Eigen::MatrixXd& metric);
  void factor(const Eigen::MatrixXd& metric);
  Eigen::VectorXd target(const Eigen::MatrixXd& metric);
  bool may_block(Eigen::Index k) const;
  const Holder& holder(Eigen::Index k) const { return holders_[near_[static_cast<std::size_t>(k)]]; }

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
