// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace codesign {

struct Study;

/// The largest range of a parameter without bounds, in its extent: farther ones follow from slopes
/// that are rounding.
constexpr double kFarthest = 1e10;

/// Scaled variables of the optimizer, doc/theory.md (24): x = (rho - lower) / (upper - lower), or
/// rho over the magnitude of its start value where a bound is missing, or over its reach() once a
/// search has stopped short.
///
/// Parameters differ by orders of magnitude (a length in metres beside a gain). Quasi-Newton
/// methods start from a unit Hessian and would fail without scaling. All vectors have p entries in
/// the order of Study::tuned.
class Scaling {
 public:
  explicit Scaling(const Study& study);

  /// Start values, unscaled.
  Eigen::VectorXd start() const { return start_; }
  /// Scaled bounds; infinite where a parameter has none.
  std::vector<double> lower() const { return lower_; }
  std::vector<double> upper() const { return upper_; }
  /// d rho_k / d x_k.
  double range(std::size_t k) const { return range_[k]; }
  /// Takes a range for a parameter without one, from its extent() at `rho` to kFarthest times that;
  /// of one that began at zero, whose start tells no size, from |rho| on.
  /// @param reach the distance over which the slope of the objective is worth the objective itself;
  /// 0: unknown.
  /// @returns whether the range has changed.
  bool reach(std::size_t k, double rho, double reach);

  std::vector<double> to_scaled(const Eigen::VectorXd& rho) const;
  /// The result is clipped to the bounds, which rounding could exceed.
  Eigen::VectorXd from_scaled(const std::vector<double>& x) const;
  /// d psi / d x from d psi / d rho.
  std::vector<double> scale_gradient(const Eigen::VectorXd& gradient) const;
  /// Euclidean norm of the scaled gradient.
  double gradient_norm(const Eigen::VectorXd& gradient) const;
  /// The same without components of parameters at a bound beyond which the objective falls.
  double free_gradient_norm(const Eigen::VectorXd& rho, const Eigen::VectorXd& gradient) const;
  /// Squared distance of x from the scaled rho, over the parameters alone. @param gradient if not
  /// empty, set to `weight` times its derivative by x.
  double square_distance(const Eigen::VectorXd& rho, const std::vector<double>& x, double weight,
                         std::vector<double>* gradient) const;

 private:
  const Study& study_;
  Eigen::VectorXd start_;
  std::vector<double> origin_, range_, lower_, upper_;
};

}  // namespace codesign
