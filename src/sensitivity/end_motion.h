// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "equations/equations.h"
#include "integration/integrator.h"
#include "integration/one_step.h"

namespace codesign {

/// How the results of a run change with the time t_e of its end, doc/theory.md (21g): the rates of
/// psi and of watched signals at t_e, and the derivatives tau' of t_e by the tuned parameters. All
/// is zero where the end does not depend on the design.
class EndMotion {
 public:
  /// @param system must outlive it.
  explicit EndMotion(const CompiledSystem& system) : system_(&system) {}

  /// Forgets the last end: until evaluate() the end does not move.
  void start() { time_.resize(0); }
  /// Evaluates the rates at the end of a run, has_ended(), with z solved for there.
  /// @param time tau', one entry per tuned parameter [s per unit]. @returns a failure of
  /// RateSolution::solve().
  Status evaluate(Integrator* integrator, const Eigen::VectorXd& time);

  /// Says that the zero of a guard has ended the run. @param rate s_t + s_x f of it. @param time
  /// tau'.
  void set_guard(int guard, double rate, const Eigen::VectorXd& time) {
    guard_ = guard;
    guard_rate_ = rate;
    time_ = time;
  }
  /// i tau' of a run in complex numbers. @param parameters complex ones. @param step has reached
  /// the end.
  std::complex<double> complex_time(const std::vector<std::complex<double>>& parameters,
                                    OneStep<std::complex<double>>* step) const;
  /// Adds what this end changes in a complex run. @param times of the watched numbers [s].
  void add_change(const std::complex<double>& time, const Eigen::VectorXd& times,
                  Equations<double>* equations, std::complex<double>* objective,
                  VectorX<std::complex<double>>* watched);

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
  const CompiledSystem* system_;
  Eigen::VectorXd time_;
  int guard_ = -1;
  double guard_rate_ = 0.0;
  double objective_rate_ = 0.0;
  State<double> state_, rates_;
  VectorX<double> residual_;
  SparseGradient<double> gradient_;
};

/// In complex numbers a guard is zero at the time t_e + i tau', theory (18g): i tau' at the end of
/// a step. @param rate s_t + s_x f of the guard.
std::complex<double> complex_guard_time(int guard, double rate,
                                        OneStep<std::complex<double>>* step);

/// The derivatives of duration_at() by the tuned parameters; zero without an expression.
Eigen::VectorXd duration_gradient(const MotionStudy& study, const std::vector<double>& parameters);

}  // namespace codesign
