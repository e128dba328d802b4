// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_SCALING_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_SCALING_H_

#include <Eigen/Core>
#include <vector>

#include "description/study.h"

namespace codesign {

/// Scaled variables x = (rho - origin) / range: bounds become 0 and 1; an unbounded parameter is measured in its start value.
///
/// Parameters differ by orders of magnitude (a length in metres beside a gain), which quasi-Newton methods with a unit start cannot bear.
class Scaling {
 public:
  explicit Scaling(const Study& study);

  Eigen::VectorXd start() const { return start_; }
  std::vector<double> lower() const { return lower_; }
  std::vector<double> upper() const { return upper_; }
  double range(std::size_t k) const { return range_[k]; }

  std::vector<double> to_scaled(const Eigen::VectorXd& rho) const;
  /// Within the bounds, whatever rounding does.
  Eigen::VectorXd from_scaled(const std::vector<double>& x) const;
  std::vector<double> scale_gradient(const Eigen::VectorXd& gradient) const;
  double gradient_norm(const Eigen::VectorXd& gradient) const;
  /// The same without the components that a bound, on which `rho` stands, keeps from falling further.
  double free_gradient_norm(const Eigen::VectorXd& rho, const Eigen::VectorXd& gradient) const;

 private:
  const Study& study_;
  Eigen::VectorXd start_;
  std::vector<double> origin_, range_, lower_, upper_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_SCALING_H_
