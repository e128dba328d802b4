// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/driven_motion.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/tangent_equations.h"

namespace codesign {

/// Derivatives, one row per number and one column per tuned parameter; rows lie side by side in
/// memory.
using RowJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Exact derivatives of the efforts by up to N of the tuned parameters, followed by the positions
/// of some drives, doc/theory.md (28b): the implicit function theorem for positions, velocities and
/// then rates, with the matrix at the solution. No allocation once warm.
template <int N>
class EffortTangent {
 public:
  /// @param system the system of the DrivenMotion whose solutions are differentiated; must outlive
  /// this.
  /// @param lanes a range of the tuned parameters followed by the shifted drives. @param shifted
  /// drives; the derivatives by their positions hold velocities and accelerations fixed
  EffortTangent(const CompiledSystem& system, LaneRange<N> lanes, std::vector<int> shifted = {});

  /// @param parameters all named parameters. Allocates.
  void set_design(const std::vector<double>& parameters) {
    equations_.equations().set_design(seeded_.seed(system_, parameters));
  }
  /// Later results do not depend on earlier ones, to the last bit.
  void reset_pivots() { equations_.equations().compiled().use_first_variant(); }

  /// @param motion with the design of set_design() and linearized at `state`, its solution.
  /// @param jacobian the rows from first_row on get the derivatives in the columns of the lanes:
  /// one for each drive, then one for each watched signal.
  void differentiate(const DrivenMotion& motion, const State<double>& state, Eigen::Index first_row,
                     RowJacobian* jacobian);

 private:
  /// The derivatives of the watched signals, with those of the rates in solution_.
  void differentiate_signals(const State<double>& state, Eigen::Index first_row,
                             RowJacobian* jacobian);
  /// Computes the derivatives of Phi, and of theta - y for the drives, along y_ and the lanes.
  void constraint_errors(const State<double>& state);
  /// Corrects the n directions of y_ from `first` on for the derivatives of the errors of the
  /// constraints.
  void correct(const DrivenMotion& motion, const Directions<N>& errors, int first);

  const CompiledSystem& system_;
  const Layout& layout_;
  const IncrementLayout at_;
  const LaneRange<N> lanes_, seeded_;  ///< all lanes, and the lanes of parameters
  const std::vector<int> shifted_;
  TangentEquations<N> equations_;
  Directions<N> y_, G_, Phi_, Phi_rate_, solution_;
};

}  // namespace codesign
