// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace codesign {

/// The step problem of Levenberg-Marquardt within bounds, doc/theory.md (24g):
///   minimize g^T p + |R p|^2 + mu |D p|^2    over    lower <= p <= upper,
/// solved exactly by an active set. For the free components it uses QR factorizations of the
/// columns of [R D^-1; sqrt(mu) 1] and the corrected seminormal equations, since g is known and R^T
/// R p = -g/2 has no other right side.
///
/// Directions with singular values of R D^-1 below 1e-9 of the largest one are held: the step has a
/// component along them only where a bound requires it. Otherwise rounding errors would determine
/// that component.
class BoundedStep {
 public:
  /// @param root R. @param scale the diagonal of D, positive. @param lower at most 0, @param upper
  /// at least 0; may be infinite.
  BoundedStep(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& root, Eigen::VectorXd scale,
              Eigen::VectorXd lower, Eigen::VectorXd upper);

  /// The minimum for one damping mu > 0. Components on a bound equal it exactly.
  Eigen::VectorXd damped(double mu) const;
  /// The minimum of g^T p + |R p|^2 over the bounds and |D p| <= radius, to 10 % of the radius
  /// where that counts.
  Eigen::VectorXd within(double radius) const;
  /// The decrease that the model predicts, -(g^T p + |R p|^2).
  double predicted_decrease(const Eigen::VectorXd& p) const;
  /// g^T p.
  double slope(const Eigen::VectorXd& p) const { return gradient_.dot(scale_.cwiseProduct(p)); }
  /// |D p|.
  double length(const Eigen::VectorXd& p) const { return scale_.cwiseProduct(p).norm(); }

 private:
  enum class AtBound { kFree, kLower, kUpper };
  void hold_null_directions();
  void solve_free(double mu, const std::vector<Eigen::Index>& free, Eigen::VectorXd* y) const;
  bool move_towards(const Eigen::VectorXd& target, const std::vector<Eigen::Index>& free,
                    std::vector<AtBound>* places, Eigen::VectorXd* y) const;
  bool release(double mu, const Eigen::VectorXd& y, std::vector<AtBound>* places) const;
  Eigen::VectorXd unscaled(const Eigen::VectorXd& y, const std::vector<AtBound>& places) const;

  // In y = D p.
  const Eigen::VectorXd scale_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd root_;
  const Eigen::VectorXd step_lower_, step_upper_;  ///< of p
  const Eigen::VectorXd lower_, upper_;
};

}  // namespace codesign
