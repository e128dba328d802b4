// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integration/applied_work.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// Limits of a measure of a run's accuracy: beyond `warning` the run warns, beyond `failure` it fails.
struct RunLimit {
  double warning = 0.0, failure = 0.0;
};

/// Limits of Statistics::constraint_drift, doc/theory.md (17a): next to a singular position an accurate step may drift by up to
/// 1/sqrt(relative_tolerance).
RunLimit drift_limit(double relative_tolerance);
/// Limits of Statistics::energy_error, doc/theory.md (17a). Accurate runs stay within a hundred times the relative tolerance.
RunLimit energy_limit(double relative_tolerance);

/// Checks after each step the drift off the constraints and the energy balance, doc/theory.md (17a). No allocation in check().
class RunWatch {
 public:
  explicit RunWatch(const CompiledSystem& system);

  /// @param equations must hold the design. @param initial its initial state.
  void start(const Equations<double>& equations, const State<double>& initial);
  /// Continues after an instant at which design or inputs jump; the energy that the jump adds or removes does not count as an error.
  void go_on(const Equations<double>& equations, const State<double>& state);
  const BodyMotion& motion() const { return motion_; }

  /// The drift d of (17a) [-]: the largest projection correction of a coordinate or velocity over its error tolerance.
  /// @param position_correction, velocity_correction delta q and delta v of (17) in the first n entries.
  double drift(const State<double>& state, const VectorX<double>& position_correction, const VectorX<double>& velocity_correction) const;

  /// To be called after each step, with its end. @param drift of the step, from drift(). @param work of all forces but gravity over the
  /// step [J]. @param statistics receives the largest drift and energy error so far. @returns kConstraintDrift, kEnergyError or ok.
  Status check(const State<double>& state, double drift, double work, Statistics* statistics);

  /// `constraint_drift` and `energy_error`, if the run so far exceeds their limits.
  Warnings warnings(const Statistics& statistics) const;

 private:
  double smallest_scale(const Constants<double>& constants, const State<double>& initial) const;
  void note_reach(const VectorX<double>& change, const VectorX<double>& of);

  const CompiledSystem& system_;
  const SolverOptions& options_;
  const RunLimit drift_limit_, energy_limit_;
  BodyMotion motion_;
  double start_potential_ = 0.0, start_energy_ = 0.0;                     ///< [J]
  double potential_ = 0.0;                                                ///< at the last step [J]
  double imbalance_ = 0.0;                                                ///< energy not explained by work, at the last step [J]
  double work_ = 0.0, turnover_ = 0.0, scale_ = 0.0, worst_error_ = 0.0;  ///< [J]
  double worst_drift_time_ = 0.0, worst_error_time_ = 0.0;                ///< [s]
  VectorX<double> start_q_, moved_;                                       ///< q at the start, and what it has changed by
  double reach_ = 0.0;        ///< r of (17a), at most 1: how far the motion has come, relative to what its tolerances resolve
  int unbalanced_steps_ = 0;  ///< consecutive steps with an energy error above RunLimit::failure
};

}  // namespace codesign
