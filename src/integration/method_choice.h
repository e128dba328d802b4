// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/compiled_system.h"
#include "integration/one_step.h"

namespace codesign {

/// The change-over between dopri5() and rodas5p() of `solver: {method: auto}`, theory (15c): a run
/// begins explicitly, or implicitly if the mechanism has dry friction, goes on implicitly when
/// stability limits the explicit steps, and returns when steps of the same size would be stable
/// explicitly. Where explicit stages have to factor a matrix each, since no program gives the
/// accelerations (loops, long chains), it also compares how far both methods come at the same cost.
/// Loops that share reactions, (23), are integrated by rodas4() throughout.
class MethodChoice {
 public:
  explicit MethodChoice(const CompiledSystem& system);

  /// Begins a run. @returns the method of the first step
  const RosenbrockTableau& start();
  /// The method of the next step. @param step after its last attempt was accepted. @param
  /// at_bound StabilityBound::limits() of that attempt.
  const RosenbrockTableau& next(OneStep<double>* step, bool at_bound);

 private:
  bool is_stiff(const OneStep<double>& step, bool at_bound);
  bool is_calm(OneStep<double>* step);
  bool is_due(OneStep<double>* step);
  void begin_explicitly(int look);
  void begin_implicitly();

  const bool is_automatic_;
  const RosenbrockTableau* first_;
  int stiff_ = 0, others_ = 0;  ///< explicit steps at the limit of stability; others in a row
  int waits_ = 0;               ///< implicit steps before the next look
  int pause_ = 0;               ///< implicit steps before the first look after a change
  double pace_ = 0.0;           ///< size of the last steps of the present method, smoothed [s]
  double explicit_pace_ = 0.0;  ///< the same of the explicit steps before a trial [s]
  int look_ = 0;                ///< explicit steps of this stretch before a trial
  int explicit_ = 0;            ///< explicit steps of this stretch
  int trial_ = 0;               ///< implicit steps that are left of a trial
  const int states_;            ///< entries of an increment before z
  VectorX<double> direction_;   ///< of OneStep::spectral_radius()
};

}  // namespace codesign
