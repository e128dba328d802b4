// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
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

}  // namespace codesign
