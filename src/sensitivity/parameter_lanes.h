// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_
#define MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_

#include <vector>

#include "sensitivity/adjoint_step.h"
#include "sensitivity/lane_groups.h"
#include "sensitivity/lane_plan.h"

namespace codesign {

/// The explicit part of the gradient, the sum of mu^T G_rho over all evaluations of the steps, for the parameters in up to N - 1 lanes of a
/// plan; doc/theory.md (18d). The sums are kept per row, from which collect() separates the parameters that share a lane.
///
/// The plan is checked: one more lane has the direction sum_k xi_k e_k of all parameters of the group, and the derivative of each row along
/// it must equal the sum over the other lanes of their derivatives times the xi_k of the parameter that the plan assigns to row and lane.
template <int N>
class ParameterLanes {
 public:
  /// @param lanes at most N - 1. @param plan must outlive this.
  ParameterLanes(const CompiledSystem& system, LaneRange<N> lanes, const LanePlan& plan);

  /// Begins a backward pass with zero sums. @param parameters all named parameters.
  void start(const std::vector<double>& parameters);
  // The terms of (18d) of one step: stages, projection, matrices.
  void add_stages(const AdjointStep& adjoint);
  void add_projection(const AdjointStep& adjoint);
  void add_matrices(const State<double>& start, const AdjointStep& adjoint);
  /// Adds the sums to the components of their parameters; p entries.
  void collect(Eigen::VectorXd* gradient) const;
  /// False if a row of G was found to depend on a parameter that the plan does not assign to it.
  bool plan_holds() const;

 private:
  using Scalar = Lanes<N>;
  using Vector = typename Scalar::Vector;
  void load(const State<double>& at);
  void check(std::size_t row, const Scalar& value);
  void add_errors(const VectorX<Scalar>& errors, const VectorX<double>& mu);
  void add_entries(const Sparsity& pattern, const std::vector<Scalar>& values, const std::vector<double>& weights);

  const CompiledSystem& system_;
  const Layout& layout_;
  const LaneRange<N> lanes_;
  const LanePlan& plan_;
  std::vector<Scalar> seeded_;  ///< the parameters of start(), with their directions
  Equations<Scalar> equations_;
  Linearization<Scalar> derivatives_;
  State<Scalar> state_;
  VectorX<Scalar> G_, Phi_, Phi_rate_;
  Scalar g_;
  std::vector<Vector> sums_;                     ///< per row
  std::vector<Vector> xi_;                       ///< per row and lane: xi_k of the assigned parameter, or 0
  std::vector<double> largest_, largest_error_;  ///< per row, of the derivative along the lane that checks the plan
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_
