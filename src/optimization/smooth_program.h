// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/signal_rows.h"

namespace codesign {

/// The smooth problem that stands for a robust measure, peaks and constraints on signals; theory
/// (24b)-(24d). Its variables are rho and slack variables: the variables of SlackForm, then one p
/// per scenario and term that is the largest of many values, and one c per scenario and centre of a
/// stroke, for which
///   psi_i = other terms + sum_j factor_j p_ij,
///   |signal_j - reference_j - c_ij| <= p_ij in scenario i.
/// The units of all numbers are chosen at the start: the unit of each psi is the unit of the scaled
/// objective, the unit of each p is its magnitude, that of c half the stroke.
class SmoothProgram {
 public:
  explicit SmoothProgram(const Ensemble& ensemble);

  int slacks() const { return slack_.variables() + static_cast<int>(units_.size()); }
  int inequalities() const { return slack_.constraints() + inequality_rows_; }
  int equalities() const { return equality_rows_; }
  bool has_signals() const { return inequality_rows_ + equality_rows_ > 0; }
  /// Whether a bound of a signal is an expression of a parameter (index in Study::parameters).
  bool bounds_read(int parameter) const;
  bool has_robust_slack() const { return slack_.variables() > 0; }
  double lower(int slack) const;

  /// Chooses the units and returns slack variables that are feasible. @param unit of psi.
  Eigen::VectorXd start(const EnsembleEvaluation& at, double unit);
  /// Takes over the evaluation that the functions below read; `all` must be ok and outlive their
  /// calls.
  void take(const EnsembleEvaluation& all, const Eigen::VectorXd& rho);

  /// A number with its derivatives by rho (unscaled) and the slack variables.
  struct Value {
    double value = 0.0;
    Eigen::VectorXd by_rho, by_slack;
    Value operator-() const { return {-value, -by_rho, -by_slack}; }
  };
  Value objective(const Eigen::VectorXd& slack) const;
  /// Left sides c <= 0 and c = 0.
  Value inequality(int row, const Eigen::VectorXd& slack) const;
  Value equality(int row) const;

  /// One result per watched signal; empty without any. @param initial the evaluation at the start
  /// of the search, or null.
  std::vector<WatchedResult> describe(const std::vector<Extremes>& extremes,
                                      const std::vector<Extremes>& initial,
                                      const Eigen::VectorXd& rho) const;
  /// The largest violation of any bound over all scenarios.
  double violation(const std::vector<Extremes>& extremes, const Eigen::VectorXd& rho) const;

 private:
  struct WatchedRow {
    std::size_t scenario;
    const SignalRow* row;
  };

  Value blank() const;
  Value signal_value(const WatchedRow& place) const;
  /// Number of the slack variables p and c of a scenario.
  int peak_variable(std::size_t scenario, int peak) const {
    return slack_.variables() + first_[scenario] + peak;
  }
  int centre_variable(std::size_t scenario, int centre) const {
    return peak_variable(scenario, static_cast<int>(rows_[scenario].peaks().size()) + centre);
  }
  double& unit_of(int variable) { return units_[variable - slack_.variables()]; }
  double unit_of(int variable) const { return units_[variable - slack_.variables()]; }
  const WatchedSignal& peak_signal(std::size_t scenario, int peak) const;
  /// Derivative of psi_i by that variable, both in their units.
  double peak_factor(std::size_t scenario, int peak) const;

  const Ensemble& ensemble_;
  SlackForm slack_;
  std::vector<SignalRows> rows_;  ///< one per scenario
  std::vector<int> first_;        ///< per scenario: its first p
  std::vector<bool> is_free_;     ///< per p and c: whether it may be negative
  std::vector<WatchedRow> inequality_places_, equality_places_;
  int inequality_rows_ = 0, equality_rows_ = 0;
  double unit_ = 1.0;
  Eigen::VectorXd units_;  ///< per p and c
  // The evaluation that was taken over: psi without the terms of p and its gradients, one per
  // scenario.
  const EnsembleEvaluation* all_ = nullptr;
  Eigen::VectorXd smooth_values_;
  Eigen::MatrixXd smooth_gradients_;
  std::vector<std::vector<double>> parameters_;  ///< of each scenario
};

}  // namespace codesign
