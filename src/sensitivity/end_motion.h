// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "equations/equations.h"
#include "integration/integrator.h"

namespace codesign {

/// How the results of a run change with the time t_e of its end, doc/theory.md (21g): the rates of
/// psi and of watched signals at t_e, and the derivatives tau' of t_e by the tuned parameters. All
/// is zero where the end does not depend on the design.
class EndMotion {
 public:
  /// @param system must outlive it.
  explicit EndMotion(const CompiledSystem& system) : system_(system) {}

  /// Forgets the last end: until evaluate() the end does not move.
  void start() { time_.resize(0); }
  /// Evaluates the rates at the end of a run, has_ended(), with z solved for there.
  /// @param time tau', one entry per tuned parameter [s per unit]. @returns a failure of
  /// Assembly::solve_rates().
  Status evaluate(Integrator* integrator, const Eigen::VectorXd& time);

  void set_time(const Eigen::VectorXd& time) { time_ = time; }

  bool moves() const { return time_.size() > 0; }
  /// tau'; empty without a moving end.
  const Eigen::VectorXd& time() const { return time_; }
  /// d psi / d t_e = g + dw/dt along the motion [unit of psi per s].
  double objective_rate() const { return objective_rate_; }
  /// The same of a watched signal minus its reference.
  double watched_rate(std::size_t k, Equations<double>* equations);
  /// The state at the end with its z, and its rates.
  const State<double>& state() const { return state_; }
  const State<double>& rates() const { return rates_; }

 private:
  double rate_of(const SparseGradient<double>& gradient) const;

  const CompiledSystem& system_;
  Eigen::VectorXd time_;
  double objective_rate_ = 0.0;
  State<double> state_, rates_;
  VectorX<double> residual_;
  SparseGradient<double> gradient_;
};

/// The derivatives of duration_at() by the tuned parameters; zero without an expression.
Eigen::VectorXd duration_gradient(const MotionStudy& study, const std::vector<double>& parameters);

}  // namespace codesign
