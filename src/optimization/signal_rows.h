// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "description/ensemble.h"
#include "description/motion_study.h"
#include "integration/watch_layout.h"
#include "mechanism_codesign/gradient.h"

namespace codesign {

/// The worst case and the conditional value at risk of scenarios psi_i with weights w_i as smooth
/// problems with slack variables y:
///   worst:  minimize t                                subject to psi_i <= t,    y = t
///   CVaR:   minimize t + sum_i w_i z_i / (1 - level)  subject to psi_i - t <= z_i, z_i >= 0,
///           y = (t, z_1, ..., z_S)
/// (Rockafellar and Uryasev 2002). The other measures need no slack variables: variables() is 0.
class SlackForm {
 public:
  /// @param weights w, one per scenario.
  SlackForm(const RobustOptions& options, Eigen::VectorXd weights);

  /// Number of slack variables.
  int variables() const;
  /// Number of constraints psi_i - t - z_i <= 0: one per scenario, of groups one per group with
  /// its mean as psi_i, or none without slack variables.
  int constraints() const { return variables() > 0 ? static_cast<int>(shares_.rows()) : 0; }
  /// The share of each scenario in psi_i of constraint i, sum 1.
  double share(int i, std::size_t scenario) const {
    return shares_(i, static_cast<Eigen::Index>(scenario));
  }
  /// The lower bound of slack variable k: minus infinity for t, 0 for z.
  double lower(int k) const;

  /// Slack variables that are feasible and optimal for given psi. @param threshold value at risk of
  /// psi, or its maximum for the worst case.
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
  Eigen::MatrixXd shares_;  ///< one row per constraint
};

/// One smooth constraint on a watched signal in one scenario, theory (24d). With x the value at an
/// instant, the extreme value in a window or the measure:
///   sign x - sign bound <= 0, or = 0 for an equality    of a constraint
///   sign (x - c) - bound/2 <= 0                          of the upper bound of a stroke
///   sign x - p <= 0, sign (x - c) - p <= 0               of a peak and of a stroke to minimize
/// p and c are slack variables: the peak, or half the stroke, and the centre of the stroke.
struct SignalRow {
  std::size_t watched = 0;  ///< index in Study::watched
  int place = 0;            ///< index of x among the numbers of WatchLayout
  double sign = 1.0;
  int peak = -1;    ///< number of p among SignalRows::peaks(); -1: a constraint
  int centre = -1;  ///< number of c among SignalRows::centres(); -1: none
};

/// The rows of all watched signals of a study, which are the same at every design.
class SignalRows {
 public:
  explicit SignalRows(const MotionStudy& study);

  const std::vector<SignalRow>& inequalities() const { return inequalities_; }
  const std::vector<SignalRow>& equalities() const { return equalities_; }
  /// Indices in Study::watched of the terms that have a slack variable p: is_largest_of_many().
  const std::vector<std::size_t>& peaks() const { return peaks_; }
  /// Indices in Study::watched of the strokes that have a slack variable c.
  const std::vector<std::size_t>& centres() const { return centres_; }
  const WatchLayout& layout() const { return layout_; }
  /// The least p, and the centre and half of the range, of the present values.
  struct Centre {
    double value, half_range;
  };
  double peak(int peak, const Extremes& extremes) const;
  Centre centre(int centre, const Extremes& extremes) const;

  /// The left side of a row without p and c. @param parameters all
  /// named parameters of the scenario.
  double value(const SignalRow& row, const Extremes& extremes,
               const std::vector<double>& parameters) const;
  /// Derivative of value() by the k-th tuned parameter.
  double derivative(const SignalRow& row, std::size_t k, const Extremes& extremes,
                    const std::vector<double>& parameters) const;
  /// The largest violation of the bounds of one watched signal; 0 if they are met.
  double violation(std::size_t watched, const Extremes& extremes,
                   const std::vector<double>& parameters) const;

 private:
  void add(std::size_t watched, double sign, int peak, int centre = -1);
  void add_term(std::size_t watched);
  void add_measure(std::size_t watched);
  const Quantity& bound(const SignalRow& row) const;
  static double bound_factor(const SignalRow& row);

  const MotionStudy& study_;
  const WatchLayout layout_;
  std::vector<SignalRow> inequalities_, equalities_;
  std::vector<std::size_t> peaks_, centres_;
};

}  // namespace codesign
