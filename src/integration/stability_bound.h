// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/solver_options.h"
#include "equations/compiled_system.h"
#include "integration/one_step.h"

namespace codesign {

/// The largest step at which an explicit pair is stable where nothing moves, doc/theory.md (15d).
///
/// A motion that is unstable shows in the error test, and its stiffness in (15c). Where nothing
/// moves neither sees anything: the test because there is no error, (15c) because it is 0/0. The
/// sensitivities grow there all the same.
class StabilityBound {
 public:
  explicit StabilityBound(const CompiledSystem& system);

  /// Begins a run.
  void start();
  /// Whether the last attempt of `step`, not yet accepted, is stable or moves; always true for an
  /// implicit method. Where it does not move, the spectral radius of the equations is estimated by
  /// the power method, with differences of the accelerations as products, in some of the steps.
  bool allows(OneStep<double>* step);
  /// The size of the next attempt [s], `proposal` or less.
  double shorten(double proposal);
  /// Whether shorten() has made the last proposal shorter.
  bool limits() const { return limits_; }

 private:
  bool rests(const OneStep<double>& step) const;
  bool is_due(double h);
  void estimate(OneStep<double>* step);
  bool multiply(OneStep<double>* step);
  double length(double per_time) const;
  void begin_direction();

  const IncrementLayout at_;
  const SolverOptions& options_;
  VectorX<double> direction_;  ///< the eigenvector's estimate, q, s and v
  State<double> beside_;       ///< a state along it
  double radius_ = 0.0;        ///< of the equations: their largest |eigenvalue| [1/s]
  double last_ = 0.0;          ///< the last estimate of it
  double largest_ = 0.0;       ///< stable step, infinity where the last attempt moved [s]
  bool limits_ = false, has_settled_ = false;
  int looks_ = 0, waits_ = 0;  ///< estimates so far; attempts at rest before the next one
};

}  // namespace codesign
