// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/turn_follower.h"
#include "integration/increment.h"
#include "integration/stage_matrix.h"
#include "integration/tableau.h"
#include "math/arrays.h"

namespace codesign {

/// What the methods of a OneStep work on: the state at which a step begins, its stages and
/// increments, and the end that they give.
template <class T>
struct StepMemory {
  StepMemory(const CompiledSystem& of_system, const RosenbrockTableau& of_method)
      : system(of_system),
        layout(system.layout()),
        at(layout),
        tableau(&of_method),
        equations(system),
        turns(system),
        stage_matrix(system),
        projection_matrix(system),
        increments(to_index(std::max(tableau->stages, most_stages(system.study().solver.method))),
                   VectorX<T>::Zero(at.size())),
        stages(increments.size()) {
    derivatives.resize(system.patterns());
    for (State<T>* one : {&state, &end}) one->resize(layout);
    for (State<T>& stage : stages) stage.resize(layout);
    z.setZero(layout.columns());
  }

  std::size_t count() const { return to_index(tableau->stages); }
  /// A row of factors, as far as the tableau has stages.
  In<double> of_stages(const RosenbrockTableau::Row& factors) const {
    return In<double>(factors).first(tableau->stages);
  }
  /// The derivatives at `end`, where the next step begins.
  void linearize_end() {
    equations.linearize(end, &derivatives);
    has_derivatives = true;
  }

  const CompiledSystem& system;
  const Layout& layout;
  const IncrementLayout at;
  const RosenbrockTableau* tableau;
  mutable Equations<T> equations;  ///< evaluations write to their memory
  mutable TurnFollower<T> turns;   ///< likewise
  StageMatrix<T> stage_matrix, projection_matrix;
  Linearization<T> derivatives;
  bool has_derivatives = false;  ///< whether they are those at `end`, where the next step begins
  State<T> state;                ///< where the step begins
  State<T> end;                  ///< before projection
  std::vector<VectorX<T>> increments;
  std::vector<State<T>> stages;
  VectorX<T> residual, z;
  double h = 0.0;  ///< [s]
};

/// What a kind of one-step method does in a step; doc/theory.md (15), (15b).
template <class T>
class StepMethod {
 public:
  virtual ~StepMethod() = default;

  /// Prepares the first step from StepMemory::state, which is `end`, too.
  virtual void begin() = 0;
  /// Forgets what it knows of the beginning of the next step: another method has taken the last.
  virtual void forget() = 0;
  /// Whether its steps solve with a matrix, whose pivots are to be chosen.
  virtual bool needs_matrix() = 0;
  /// Computes the increments, the stages and the end of a step of size h. False if a matrix is
  /// singular or a value is not finite.
  virtual bool attempt() = 0;
  /// The estimated error of the end, and the factor by which it counts.
  virtual const VectorX<T>& estimate() const = 0;
  virtual double caution() const = 0;
  /// Computes what projection and next step need at the end of a step. @param is_last whether the
  /// step is that of the last attempt.
  virtual void finish(bool is_last) = 0;
  /// Sets z of a point of the dense output where it is more than the sum over the stages.
  virtual void interpolate_z(double theta, const State<T>& from, State<T>* state) const = 0;
  /// Its derivative by time.
  virtual void interpolate_z_rates(double theta, State<T>* rates) const = 0;
};

}  // namespace codesign
