// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "integration/step_method.h"

namespace codesign {

/// The stages of a Rosenbrock-Wanner method, doc/theory.md (15), (16). The unknowns q, v, s of each
/// stage are eliminated, so that one sparse matrix of the size of (a, lambda, sigma) serves all
/// stages. Projection and next step use the derivatives at the unprojected end, so that a step
/// needs one linearization.
template <class T>
class RosenbrockStages : public StepMethod<T> {
 public:
  /// @param memory must outlive this.
  explicit RosenbrockStages(StepMemory<T>* memory) : m_(*memory), product_(memory->system) {}

  void begin() override { m_.linearize_end(); }
  void forget() override {}
  bool needs_matrix() override { return true; }
  bool attempt() override;
  /// The method is stiffly accurate.
  const VectorX<T>& estimate() const override { return m_.increments[m_.count() - 1]; }
  double caution() const override { return 1.0; }
  void finish(bool /*is_last*/) override { m_.linearize_end(); }
  void interpolate_z(double, const State<T>&, State<T>*) const override {}
  void interpolate_z_rates(double, State<T>*) const override {}

  const StageProduct& product() const { return product_; }

 private:
  void stage_start(std::size_t i);
  bool solve_stage(std::size_t i);

  StepMemory<T>& m_;
  StageProduct product_;
};

}  // namespace codesign
