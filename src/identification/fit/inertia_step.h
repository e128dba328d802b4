// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identification/fit/relative_inertia.h"

namespace codesign {

/// A free inertia in an InertiaStep.
struct InertiaBlock {
  std::array<int, 10> columns{};  ///< of symmetric_numbers() of its step in p
  Eigen::Matrix4d matrix;         ///< E at p = 0, positive definite
  double weight = 0.0;            ///< w, positive
};

/// One step of a fit with free inertias, doc/theory.md (39d): the convex problem
///   minimize g^T p + |A p|^2 + sum_l w_l (tr E_l - ln det E_l)    over    lower <= p <= upper,
/// with E_l = matrix + symmetric_matrix(p of its columns) positive definite. Newton's method
/// follows the minima for falling weights down to w_l (Boyd and Vandenberghe, Convex Optimization,
/// 11.3), so that it also ends next to the border of the possible inertias, where w_l E_l^-1 is the
/// multiplier of the semidefinite constraint. Bounds are kept by an active set, and components on a
/// bound equal it exactly.
class InertiaStep {
 public:
  /// @param root A, with as many columns as p. @param lower at most 0, @param upper at least 0; may
  /// be infinite; not of the columns of blocks
  InertiaStep(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root,
              const std::vector<InertiaBlock>& blocks, const Eigen::VectorXd& lower,
              const Eigen::VectorXd& upper);

  const Eigen::VectorXd& step() const { return p_; }
  /// The decrease of the function that is minimized, from p = 0.
  double decrease() const;
  /// E_l after the step.
  const Eigen::Matrix4d& matrix(std::size_t block) const { return matrices_[block]; }

 private:
  enum class AtBound { kFree, kLower, kUpper };
  struct Direction {
    Eigen::VectorXd s;
    double decrease = 0.0;  ///< that Newton's model predicts
  };
  void follow();
  void minimize(double factor, double enough);
  Eigen::VectorXd slope(double factor) const;
  Direction newton(double factor, const Eigen::VectorXd& slope) const;
  double length_along(const Eigen::VectorXd& s, double factor, double most) const;
  bool advance(const Direction& direction, double factor);
  bool release(const Eigen::VectorXd& slope);

  const Eigen::VectorXd& gradient_;
  const Eigen::MatrixXd& root_;
  const std::vector<InertiaBlock>& blocks_;
  const Eigen::VectorXd &lower_, &upper_;
  std::vector<AtBound> places_;
  std::vector<Eigen::Matrix4d> matrices_;
  Eigen::VectorXd p_;
};

}  // namespace codesign
