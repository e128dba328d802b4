// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "math/scalar.h"

namespace codesign {

class CompiledSystem;
template <int N>
class Directions;
struct IncrementLayout;
struct SolverOptions;
template <class T>
struct State;

/// The error test of sensitivities along N directions, doc/theory.md (18f). Positions, velocities,
/// extra states and psi are judged apart, each direction in the scale of its own largest size so
/// far. Within a short contact, sensitivities of velocities are the acceleration times a shift of
/// the time, and vanish with it: sizes there count as at most the mean over the time so far.
template <int N>
class SensitivityScale {
 public:
  using Array = Eigen::Array<double, N, 1>;

  /// What a step does to the sensitivities.
  struct Attempt {
    const State<double>& state;     ///< at its end, with its z
    const Directions<N>& end;       ///< there, positions, extra states and velocities
    const Directions<N>& estimate;  ///< of its error
    Array psi;                      ///< psi' at its end
    double objective;               ///< psi at its beginning
  };

  /// Begins a run. @param parameters all named parameters, with the directions in the lanes.
  void start(const CompiledSystem& system, const std::vector<Lanes<N>>& parameters);
  /// Takes the sizes at the end of an accepted step.
  void measure(const IncrementLayout& at, const State<double>& state, const Directions<N>& y);
  /// The largest error over the directions, acceptable up to 1. @param tolerance relative.
  double error(const IncrementLayout& at, const Attempt& attempt, double tolerance) const;

 private:
  /// The size of a sensitivity over the run.
  struct Size {
    Array largest;   ///< square of the largest one so far
    Array last;      ///< at the end of the last step
    Array integral;  ///< over the time
  };
  /// The square of a size, `now`, as it counts at time t.
  Array counted(const Size& of, const Array& now, double t, bool is_short) const;
  void extend(const Array& now, double t, bool is_short, Size* of) const;
  /// Whether velocities change by as much as the largest one in a small part of the run.
  bool is_short_contact(const State<double>& state) const;

  Array q_, s_;  ///< squares of the largest sizes so far
  Size v_, psi_;
  /// squares of what a direction is in units of the parameters' values and ranges
  Array per_value_, per_range_;
  double q_square_ = 0.0, v_square_ = 0.0, s_square_ = 0.0;  ///< of the motion itself
  double absolute_ = 0.0;               ///< an error over the range that does not count
  double time_ = 0.0, duration_ = 0.0;  ///< of the last step's end, and of the study [s]
  bool may_touch_ = false;              ///< whether there are switches, as each contact has one
};

/// The tolerance of sensitivities in the error test of a run with gradient:
/// solver.sensitivity_tolerance, or its default: ten times relative_tolerance, but at most 1e-3,
/// and 1e-5 (or a hundred times relative_tolerance, if that is less) where that would be less.
double sensitivity_tolerance(const SolverOptions& options);

}  // namespace codesign
