// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_DYNAMICS_REDUNDANCY_H_
#define MECHANISM_CODESIGN_DYNAMICS_REDUNDANCY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mechanism_codesign/dynamics/counts.h"
#include "mechanism_codesign/dynamics/equations.h"

namespace codesign {

/// Which constraints of a mechanism depend on the others at one position, and whose reactions that leaves undetermined; doc/theory.md (23).
struct Redundancy {
  std::vector<ConstraintRow> rows;           ///< as many as the rank lacks; without them the others are independent
  std::vector<std::string> undetermined;     ///< joints, loops and couplings whose multipliers are not unique
  std::vector<std::string> friction_chosen;  ///< those among them whose friction depends on the reaction
};

/// Phi_q at a state, dense (m x n).
Eigen::MatrixXd constraint_jacobian(const System& system, Equations<double>* equations, const State<double>& state);

/// Rank by a pivoted QR factorization, relative threshold 1e-9; multipliers that are not unique are those that a vector of the null space
/// of Phi_q^T moves.
/// @param Phi_q (m x n) at a position where the constraints hold.
Redundancy analyse_redundancy(const System& system, const Equations<double>& equations, const Eigen::MatrixXd& Phi_q);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_DYNAMICS_REDUNDANCY_H_
