// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "mechanism_codesign/warning.h"

namespace codesign {

class CompiledSystem;

/// Finds the first singular position that a run passes, where the rank of Phi_q drops and
/// sensitivities lose digits; doc/theory.md (17b).
///
/// Near a singular position the drift (17a) of the steps has a peak. The response of the augmented
/// matrix is evaluated only at a peak, found from the ends of three steps, so that runs without a
/// peak cost nothing.
class SingularityWatch {
 public:
  explicit SingularityWatch(const CompiledSystem& system);

  /// @param enabled whether look() does anything. @param initial state of the run, for the usual
  /// rank. Pivots of earlier runs are kept: they have no influence on the motion.
  void start(bool enabled, const State<double>& initial);
  /// To be called after each step, with its end. @param drift of the step, from RunWatch::drift().
  /// @param equations must hold the design.
  void look(const State<double>& state, double drift, Equations<double>* equations);

  /// `singular_position_passed` with time and rank, if one was found.
  Warnings warnings() const { return warnings_; }

 private:
  struct Point {
    double drift = 0.0;
    State<double> state;
  };
  bool is_peak() const;
  void search(Equations<double>* equations);
  void place(double time);
  double stiffness(Equations<double>* equations);
  int rank(Equations<double>* equations, const State<double>& state) const;

  const CompiledSystem& system_;
  /// allocated at the first peak, since few runs have one
  std::unique_ptr<IterationMatrix> matrix_;
  Linearization<double> derivatives_;
  VectorX<double> response_;
  std::array<Point, 3> points_;
  State<double> initial_, between_;
  double typical_stiffness_ = 0.0, sum_of_logarithms_ = 0.0, threshold_ = 0.0;
  int count_ = 0;
  bool enabled_ = false;
  Warnings warnings_;
};

}  // namespace codesign
