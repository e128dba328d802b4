// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_RUN_WATCH_H_
#define MECHANISM_CODESIGN_INTEGRATION_RUN_WATCH_H_

#include "integration/applied_work.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {

/// How far two figures of a run may go at a relative tolerance: up to `warning` without a word, up to `failure` with a warning.
struct RunLimit {
  double warning = 0.0, failure = 0.0;
};

/// Of Statistics::constraint_drift. Next to a singular position a right step may drift by 1/sqrt(tolerance); theory (17a).
RunLimit drift_limit(double relative_tolerance);
/// Of Statistics::energy_error. Right runs stay within a hundred times the tolerance.
RunLimit energy_limit(double relative_tolerance);

/// Watches how well a run keeps to the constraints and to the balance of energy; doc/theory.md (17a). No allocation.
class RunWatch {
 public:
  explicit RunWatch(const CompiledSystem& system);

  void start(const Constants<double>& constants, const State<double>& initial);
  const BodyMotion& motion() const { return motion_; }

  /// Drift of a state in the scale of the error test: the largest change of a coordinate or velocity, over its tolerance, that the way back
  /// to the constraints takes. @param position_correction, velocity_correction that way, n entries or more each.
  double drift(const State<double>& state, const VectorX<double>& position_correction, const VectorX<double>& velocity_correction) const;

  /// After each step, at its end. @param drift of the step. @param work [J] of everything but gravity over the step.
  Status check(const State<double>& state, double drift, double work, Statistics* statistics);

  /// What the run so far gives reason to doubt.
  Warnings warnings(const Statistics& statistics) const;

 private:
  double smallest_scale(const Constants<double>& constants, const State<double>& initial) const;

  const CompiledSystem& system_;
  const SolverOptions& options_;
  const RunLimit drift_limit_, energy_limit_;
  BodyMotion motion_;
  double start_potential_ = 0.0, start_energy_ = 0.0;                     ///< [J]
  double work_ = 0.0, turnover_ = 0.0, scale_ = 0.0, worst_error_ = 0.0;  ///< [J]
  double worst_drift_time_ = 0.0, worst_error_time_ = 0.0;                ///< [s]
  int unbalanced_steps_ = 0;                                              ///< beyond the limit, one after the other
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_RUN_WATCH_H_
