// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "integration/increment.h"
#include "integration/stage_matrix.h"
#include "sensitivity/run_jumps.h"

namespace codesign {

/// The jumps between the steps of a run, theory (18g), (52), differentiated backwards;
/// doc/theory.md (18h). The transpose of TangentStep::cross() and TangentStep::jump(). Adjoints are
/// in the order of IncrementLayout.
class AdjointJump {
 public:
  /// @param system must outlive it.
  explicit AdjointJump(const CompiledSystem& system);

  /// Begins with zero derivatives by the parameters. @param parameters all named ones
  /// (Study::parameters order).
  void start(const std::vector<double>& parameters);

  /// Adds `weight` times the derivatives of a guard s: s_x to the adjoint, and s_rho to those by
  /// the parameters. @param at the state at which it is zero. @param mode to which it belongs.
  void add_guard(int guard, double weight, const State<double>& at, const std::vector<bool>& mode,
                 VectorX<double>* adjoint);

  /// The adjoint behind a jump becomes that before it.
  /// @param before, behind the states on both sides. @param mode before it. @param end_rate what
  /// the objective changes by the instant itself [unit of psi per s], (21g): of a jump that ends
  /// the run, else 0. @returns false if G_z is singular.
  bool reverse(const RunJump& jump, const State<double>& before, const State<double>& behind,
               const std::vector<bool>& mode, double end_rate, VectorX<double>* adjoint);

  /// Adds the derivatives by the parameters of all jumps and guards since start(). @param gradient
  /// p entries, order of Study::tuned.
  void add_gradient(Out<double> gradient);

 private:
  void hold(const std::vector<bool>& mode);
  bool reverse_rates(const State<double>& behind, VectorX<double>* adjoint);
  void reverse_events(const std::vector<ControlEvent>& events, const State<double>& before,
                      VectorX<double>* adjoint);
  void reverse_event(const ControlEvent& event, VectorX<double>* adjoint);

  const CompiledSystem& system_;
  const IncrementLayout at_;
  CompiledEquations<double> equations_, samples_;
  std::unique_ptr<StageMatrix<double>> matrix_;  ///< from the first jump on
  Linearization<double> derivatives_;
  VectorX<double> residual_, mu_, weights_, no_weights_;
  VectorX<double> output_adjoint_, states_adjoint_;  ///< weights of the results of a sample
  const VectorX<double> no_integrand_;
  State<double> point_;                  ///< before an event
  std::vector<VectorX<double>> states_;  ///< the extra states before each event
};

}  // namespace codesign
