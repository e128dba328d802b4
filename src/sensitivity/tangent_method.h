// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "integration/one_step.h"
#include "math/arrays.h"
#include "sensitivity/tangent_equations.h"

namespace codesign {

/// What the methods of a TangentStep work on: the sensitivities at which a step begins, and the
/// derivatives of its stages.
template <int N>
struct TangentMemory {
  TangentMemory(const CompiledSystem& of_system, const RosenbrockTableau& of_method)
      : system(of_system),
        layout(system.layout()),
        at(layout),
        tableau(&of_method),
        equations(system),
        y(at.size()),
        stage_y(y),
        stages(to_index(std::max(tableau->stages, most_stages(system.study().solver.method))), y) {}

  std::size_t count() const { return to_index(tableau->stages); }
  /// to = from + sum of factors[j] u'_j, for the components of u' from the `first` on.
  void combine(In<double> from, In<double> factors, int first, Out<double> to) const {
    const double* parts[RosenbrockTableau::kMaximumStages];
    for (std::ptrdiff_t j = 0; j < factors.size(); ++j)
      parts[j] = stages[to_index(j)].data() + std::ptrdiff_t{N} * first;
    codesign::combine(from, factors, parts, to);
  }
  void linearize(const State<double>& state) {
    equations.linearize(state, y);
    has_changes = true;
  }

  const CompiledSystem& system;
  const Layout& layout;
  const IncrementLayout at;
  const RosenbrockTableau* tableau;  ///< of the last attempt
  TangentEquations<N> equations;
  /// whether its changes of the matrices are those with which the next step begins
  bool has_changes = false;
  Directions<N> y, stage_y, residual;
  std::vector<Directions<N>> stages;  ///< u' of each stage
};

/// What a kind of one-step method does in the derivative of a step; the counterpart of StepMethod.
template <int N>
class TangentMethod {
 public:
  virtual ~TangentMethod() = default;

  /// Prepares the first step from a state at which TangentMemory::y are the sensitivities.
  virtual void begin(const State<double>& at) = 0;
  /// Computes the derivatives of the stages of the step's last attempt. @param step may receive
  /// the factorization of a stage.
  virtual void attempt(OneStep<double>* step) = 0;
  /// The derivative of StepMethod::estimate().
  virtual const Directions<N>& estimate() const = 0;
  /// Completes y at the end of an accepted step, and prepares the next one.
  virtual void finish(const OneStep<double>& step) = 0;
  /// The derivative of StepMethod::interpolate_z(). @param before y at the begin of the step.
  virtual void interpolate_z(double theta, const Directions<N>& before) = 0;
};

/// Of RosenbrockStages. The stage equation E u = -(G + G_q w_q + G_s w_s + G_v w_v) is
/// differentiated including the derivative of E:
///   E u' = -(G' + G_q w_q' + G_s w_s' + G_v w_v'
///            + (dG_q) u_q + (dG_s) u_s + (dG_v) u_v + (dG_z) u_z),
/// with dG_x the change of G_x along (y', e_k). E is solved with the factorization of the step.
template <int N>
class RosenbrockTangent : public TangentMethod<N> {
 public:
  /// @param memory must outlive this.
  explicit RosenbrockTangent(TangentMemory<N>* memory)
      : m_(*memory),
        matrix_changes_(memory->stages.size(), Directions<N>(memory->layout.columns() + 1)) {}

  void begin(const State<double>& at) override { m_.linearize(at); }
  void attempt(OneStep<double>* step) override;
  /// The last stage lies at the end, but for the error.
  const Directions<N>& estimate() const override { return m_.stages[m_.count() - 1]; }
  void finish(const OneStep<double>& step) override { m_.linearize(step.unprojected()); }
  void interpolate_z(double, const Directions<N>&) override {}

 private:
  using Vector = typename Lanes<N>::Vector;
  /// Handles `together` stages at a time; `together` divides the number of stages.
  template <std::size_t together>
  void change_matrices(const OneStep<double>& step);
  void stage_start(std::size_t i, double h);
  void stage_tangent(std::size_t i, const OneStep<double>& step);

  TangentMemory<N>& m_;
  std::vector<Directions<N>> matrix_changes_;  ///< dG u of each stage, row by row
};

/// Of ExplicitStages: G = 0 at a stage gives G_z z' = -G' with G' at fixed z.
template <int N>
class ExplicitTangent : public TangentMethod<N> {
 public:
  /// @param memory must outlive this.
  explicit ExplicitTangent(TangentMemory<N>* memory) : m_(*memory), estimate_(memory->y) {}

  void begin(const State<double>&) override {}
  void attempt(OneStep<double>* step) override;
  const Directions<N>& estimate() const override { return estimate_; }
  void finish(const OneStep<double>& step) override;
  void interpolate_z(double theta, const Directions<N>& before) override;

 private:
  using Vector = typename Lanes<N>::Vector;
  void explicit_stage(std::size_t i, OneStep<double>* step);

  TangentMemory<N>& m_;
  Directions<N> estimate_;
};

}  // namespace codesign
