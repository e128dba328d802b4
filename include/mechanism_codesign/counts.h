// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace codesign {

/// One constraint row, an entry of Phi.
struct ConstraintRow {
  std::string joint;  ///< name of the joint, loop or coupling (or body, for unit Euler parameters)
  int row = 0;        ///< number of the row within that joint, loop, coupling or body, from 1
  std::string kind;   ///< e.g. "parallel axes, x_i . z_j", the products of doc/theory.md (6)
};

/// The numbers of the paper's table "number of equations" for a mechanism and a study, at the
/// assembled start, in absolute coordinates; and the coordinates in which the equations are solved.
struct Counts {
  int bodies = 0;                 ///< without the ground
  int coordinates = 0;            ///< n = 7 per body
  int first_order_equations = 0;  ///< 2 n
  /// extra states s: integrals of controllers, states of friction laws; not in the sums below
  int controller_states = 0;
  /// dimension of the possible motions: n - rank(Phi_q), or less at a singular position, (23a)
  int degrees_of_freedom = 0;
  int constraints = 0;            ///< m, rows of Phi
  int redundant_constraints = 0;  ///< m - rank(Phi_q)
  int dynamic_equations = 0;      ///< 2 n + m
  int parameters = 0;             ///< p, tuned parameters
  int sensitivities = 0;          ///< p (2 n + m)
  int total_equations = 0;        ///< dynamic equations + sensitivities
  /// whether the equations are solved in joint coordinates, theory (56)
  bool in_joint_coordinates = false;
  int solved_coordinates = 0;                 ///< coordinates of the solver
  int solved_constraints = 0;                 ///< its constraint rows
  std::vector<ConstraintRow> redundant_rows;  ///< rows that follow from the others, theory (23)
  /// joints, loops and couplings whose reactions are not unique, theory (23)
  std::vector<std::string> undetermined_reactions;
  /// the entries of `undetermined_reactions` whose friction depends on the reaction
  std::vector<std::string> chosen_friction;
};

}  // namespace codesign
