// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/equations.h"
#include "equations/iteration_matrix.h"

namespace codesign {

/// Projects a state onto the constraints, doc/theory.md (17), with two Newton steps, since the drift may be larger than the drift of one
/// step.
class Projection {
 public:
  explicit Projection(const CompiledSystem& system);

  /// Changes q and v so that Phi = 0 and Phi_q v = 0; z is unchanged. `equations` must hold the design. False if the augmented matrix is
  /// singular or the result is not finite.
  bool apply(Equations<double>* equations, State<double>* state);

 private:
  void correct(const VectorX<double>& error, VectorX<double>* target);

  const Layout& layout_;
  IterationMatrix matrix_;
  Linearization<double> derivatives_;
  VectorX<double> Phi_, Phi_rate_, correction_;
};

}  // namespace codesign
