// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_REDUNDANCY_H_
#define MECHANISM_CODESIGN_ASSEMBLY_REDUNDANCY_H_

#include <string>
#include <vector>

#include "assembly/assembly.h"
#include "equations/equations.h"
#include "mechanism_codesign/counts.h"

namespace codesign {

/// Which constraints of a mechanism depend on the others at one position, and whose reactions that leaves undetermined; doc/theory.md (23).
struct Redundancy {
  std::vector<ConstraintRow> rows;           ///< as many as the rank lacks, of loops and couplings; without them the others are independent
  std::vector<std::string> undetermined;     ///< joints, loops and couplings whose multipliers are not unique
  std::vector<std::string> friction_chosen;  ///< those among them whose friction depends on the reaction
  std::vector<int> chosen_joints;            ///< of the description: the joints of that friction
  Eigen::MatrixXd self_stress;               ///< by columns some multipliers of all constraints that balance each other
  double stress_threshold = 0.0;             ///< what they move by less they do not move
  ReactionSharing sharing;                   ///< without compliance. Rows that only depend on the others at this very position are kept
};

/// Phi_q at a state.
SparseMatrix constraint_jacobian(const CompiledSystem& system, Equations<double>* equations, const State<double>& state);

/// Rank of what loops and couplings ask of the tree, by a pivoted QR factorization for each set of them that shares no coordinates with
/// others. A row counts as redundant if less than 1e-3 of it is left (scaled as LoopScales says), and is dropped if it also holds after
/// motions of 0.2 rad along which the other rows hold. Multipliers that are not unique are those of loads that balance each other.
/// @param assembly at the positions of `state`, where the constraints hold.
Redundancy analyse_redundancy(const CompiledSystem& system, Equations<double>* equations, const Assembly& assembly,
                              const std::vector<double>& parameters, const State<double>& state);

/// Which of some signals read a component of a reaction that self-stresses move, so that nothing determines it.
/// @param state of the redundancy.
std::vector<std::size_t> open_reactions(const CompiledSystem& system, const Redundancy& redundancy, State<double> state,
                                        const std::vector<Signal>& signals, Equations<double>* equations);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_REDUNDANCY_H_
