// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "description/ensemble.h"

namespace codesign {

/// The worst case and the conditional value at risk of scenarios psi_i with weights w_i as smooth problems with slack variables y:
///   worst:  minimize t              subject to psi_i <= t,            y = t
///   CVaR:   minimize t + sum_i w_i z_i / (1 - level)
///                                   subject to psi_i - t <= z_i, z_i >= 0,   y = (t, z_1, ..., z_S)
/// (Rockafellar and Uryasev 2002). The other measures need no slack variables: variables() is 0.
class SlackForm {
 public:
  /// @param weights w, one per scenario.
  SlackForm(const RobustOptions& options, Eigen::VectorXd weights);

  /// Number of slack variables.
  int variables() const;
  /// Number of constraints psi_i - t - z_i <= 0: one per scenario, or none without slack variables.
  int constraints() const { return variables() > 0 ? static_cast<int>(weights_.size()) : 0; }
  /// The lower bound of slack variable k: minus infinity for t, 0 for z.
  double lower(int k) const;

  /// Slack variables that are feasible and optimal for given psi. @param threshold value at risk of psi, or its maximum for the worst case.
  Eigen::VectorXd start(const Eigen::VectorXd& psi, double threshold) const;
  /// The objective and its derivative by y.
  double objective(const Eigen::VectorXd& y) const { return gradient().dot(y); }
  Eigen::VectorXd gradient() const;
  /// The value of constraint i, psi_i - t - z_i.
  double constraint(int i, double psi, const Eigen::VectorXd& y) const;
  /// Derivative of constraint i by slack variable k.
  double by_slack(int i, int k) const { return k == 0 || k == i + 1 ? -1.0 : 0.0; }

 private:
  RobustMeasure measure_;
  double level_;
  Eigen::VectorXd weights_;
};

}  // namespace codesign
