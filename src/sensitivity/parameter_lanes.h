// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_
#define MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_

#include <vector>

#include "sensitivity/adjoint_step.h"
#include "sensitivity/lane_groups.h"
#include "sensitivity/lane_plan.h"

namespace codesign {

/// The explicit part of the gradient, sum of mu^T G_rho over all that the steps evaluated, for the parameters in up to N - 1 lanes of a
/// plan; doc/theory.md (18d). It is summed by rows, which tell the parameters of a lane apart.
///
/// A plan is believed only as far as it is seen to hold: one more lane carries the direction sum_k xi_k e_k of all parameters of the group,
/// and each row's derivative along it must be that which the plan makes of the others.
template <int N>
class ParameterLanes {
 public:
  /// @param lanes N - 1 at most.
  ParameterLanes(const CompiledSystem& system, LaneRange<N> lanes, const LanePlan& plan);

  /// @param parameters all named parameters.
  void start(const std::vector<double>& parameters);
  void add_stages(const AdjointStep& adjoint, const Equations<double>& equations);
  void add_projection(const AdjointStep& adjoint);
  void add_matrices(const State<double>& start, const AdjointStep& adjoint, const Equations<double>& equations);
  /// Adds each parameter's part to its component.
  void collect(Eigen::VectorXd* gradient) const;
  /// False if a row of G moved with a parameter that the plan does not give it.
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
  Equations<Scalar> equations_;
  Linearization<Scalar> derivatives_;
  State<Scalar> state_;
  VectorX<Scalar> G_, Phi_, Phi_rate_;
  Scalar g_;
  std::vector<Vector> sums_;                     ///< per row
  std::vector<Vector> xi_;                       ///< per row and lane: that of the parameter to which the plan gives them
  std::vector<double> largest_, largest_error_;  ///< per row, of the derivative along the checking lane
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SENSITIVITY_PARAMETER_LANES_H_
