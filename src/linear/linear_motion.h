// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "equations/equations.h"
#include "equations/iteration_matrix.h"
#include "linear/linear_coordinates.h"
#include "linear/linear_study.h"
#include "linear/state_space.h"
#include "math/scalar.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// The derivatives of a mechanism's motion about one state, theory (67): by x = (y, y', s) and by
/// the inputs u of its LinearStudy, from the recorded equations. Sampled controllers hold their
/// outputs in `flow()`; jump() has their samples. Not thread-safe.
class LinearMotion {
 public:
  /// @param system of study.study, whose watched signals are the outputs; both must outlive this.
  LinearMotion(const CompiledSystem& system, const LinearStudy& study);

  /// Another design. @param parameters those of the study and its inputs.
  void set_design(const std::vector<double>& parameters);
  /// At a state with consistent q and v; z is solved for, beginning with that of the state.
  /// Statuses: kSingularMatrix, kNonFinite.
  Status linearize(State<double> state);
  /// At rest at positions q: controllers, lags and filters have settled.
  /// @param integrals the states of the integrals of the study's controllers, then the estimates of
  /// all observers and the currents that controllers read; missing ones are zero, of estimates
  /// those of the measured position.
  Status linearize_at_rest(State<double> state, const std::vector<double>& integrals = {});

  const CompiledSystem& system() const { return system_; }
  const State<double>& state() const { return state_; }
  const LinearCoordinates& coordinates() const { return coordinates_; }
  Equations<double>& equations() { return equations_; }
  /// The motion between events of sampled controllers.
  const StateSpace& flow() const { return flow_; }
  /// The states s after events at one instant, by x and u: Layout::states rows.
  Eigen::MatrixXd jump(const std::vector<ControlEvent>& events);
  /// Number of states x before s.
  Eigen::Index motions() const { return 2 * to_signed(coordinates_.columns.size()); }

 private:
  static constexpr int kLanes = 8;
  using Number = Lanes<kLanes>;

  Status solve_rates();
  void settle(const std::vector<double>& integrals);
  void settle_estimates(const std::vector<double>& integrals);
  void settle_currents(const std::vector<double>& integrals);
  void set_directions();
  void load_lanes(Eigen::Index first);
  template <class Visit>
  void for_each_group(const Visit& visit);
  Status differentiate();

  const CompiledSystem& system_;
  const LinearStudy& study_;
  Equations<double> equations_;
  Equations<Number> lanes_;
  IterationMatrix matrix_;
  Linearization<double> derivatives_;
  State<double> state_;
  State<Number> state_lanes_;
  std::vector<double> parameters_;
  std::vector<Number> parameter_lanes_;
  LinearCoordinates coordinates_;
  /// One column per entry of x, then of u.
  Eigen::MatrixXd q_, v_, s_, z_;
  StateSpace flow_;
};

}  // namespace codesign
