// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "control/signal.h"
#include "equations/equations.h"
#include "mechanism_codesign/counts.h"
#include "system/reaction_sharing.h"

namespace codesign {

class Assembly;

class CompiledSystem;

/// The redundant constraints of a mechanism at one position, and the reactions that are therefore
/// not unique; doc/theory.md (23).
struct Redundancy {
  /// redundant rows of loops and couplings, as many as the rank lacks; the others are independent
  std::vector<ConstraintRow> rows;
  /// joints, loops and couplings whose multipliers are not unique
  std::vector<std::string> undetermined;
  /// the ones of `undetermined` whose friction depends on such a multiplier
  std::vector<std::string> friction_chosen;
  std::vector<int> chosen_joints;  ///< the joints of friction_chosen, as indices in the description
  /// constraints x trials: multipliers s with Phi_q^T s = 0, up to the loads of unit Euler
  /// parameters
  Eigen::MatrixXd self_stress;
  /// constraints x redundant rows: an orthonormal basis of the self-stresses; empty beyond 30
  /// redundant rows
  Eigen::MatrixXd basis;
  double stress_threshold = 0.0;  ///< smaller entries of self_stress count as zero
  /// compliance not set; `dropped` lacks rows that are redundant only at this very position
  ReactionSharing sharing;
};

/// Finds the redundant rows of loops and couplings by a pivoted QR factorization of each part of
/// LoopJacobian::parts(). A row is redundant if less than 1e-3 of it (in the scaling of LoopScales)
/// is independent of the other rows, and is dropped if it also holds after motions of 0.2 rad along
/// which the other rows hold. A multiplier is not unique if a self-stress, a set of loads that
/// balance each other, changes it.
/// @param assembly its last positions must equal the positions of `state`, where the constraints
/// hold.
/// @param equations must hold the design at `parameters`.
Redundancy analyse_redundancy(const CompiledSystem& system, Equations<double>* equations,
                              const Assembly& assembly, const std::vector<double>& parameters,
                              const State<double>& state);

/// Indices of the signals that read a component of a reaction that is not unique.
/// @param state the state at which `redundancy` was found.
std::vector<std::size_t> open_reactions(const CompiledSystem& system, const Redundancy& redundancy,
                                        State<double> state, const std::vector<Signal>& signals,
                                        Equations<double>* equations);

}  // namespace codesign
