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
/// the sum of squares of doc/theory.md (24j). Rows are many, variables few. At the minimum
///   c_k = max(0, a_k^T r) / d_k^2,    r = g - sum_k c_k a_k,
/// so the rows enter by a matrix of the variables, I + sum_k a_k a_k^T / d_k^2 over those with
/// a_k^T r > 0, whose set Newton's method finds. Near rows, for which the quotient is lost in
/// rounding, count as farther away, and what that adds is taken back by proximal steps.
struct Multipliers {
  Eigen::VectorXd values;  ///< c, one per holder
  Eigen::VectorXd rest;    ///< r
  double residual = 0.0;   ///< s
  int factorizations = 0;  ///< of matrices of the variables
};

/// @param holders with directions of numbers. @param cancel ends the iteration, may be null: the
/// multipliers then have their signs, but do not minimize.
Multipliers least_multipliers(const Eigen::VectorXd& gradient, const std::vector<Holder>& holders,
                              const std::atomic<bool>* cancel);

}  // namespace codesign
