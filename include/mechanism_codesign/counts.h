// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_COUNTS_H_
#define MECHANISM_CODESIGN_COUNTS_H_

#include <string>
#include <vector>

namespace codesign {

/// A row of Phi: of a joint, loop or coupling.
struct ConstraintRow {
  std::string joint;  ///< its name
  int row = 0;        ///< which of its rows, from 1
  std::string kind;   ///< what the row says
};

/// The paper's table "number of equations" for a mechanism and a study.
struct Counts {
  int bodies = 0;
  int coordinates = 0;            ///< n = 7 per body
  int first_order_equations = 0;  ///< 2 n
  int controller_states = 0;      ///< integrals and friction states beside the paper's count
  int degrees_of_freedom = 0;     ///< n - rank(Phi_q) at the start, less (23a)
  int constraints = 0;            ///< m, rows of Phi
  int redundant_constraints = 0;  ///< m - rank(Phi_q)
  int dynamic_equations = 0;      ///< 2 n + m
  int parameters = 0;             ///< p, those tuned
  int sensitivities = 0;          ///< p (2 n + m)
  int total_equations = 0;        ///< dynamic equations + sensitivities
  std::vector<ConstraintRow> redundant_rows;
  std::vector<std::string> undetermined_reactions;  ///< joints, loops and couplings whose reactions the redundant rows leave open
  std::vector<std::string> chosen_friction;         ///< those among them whose friction is computed from the reaction
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_COUNTS_H_
