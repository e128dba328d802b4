// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SYSTEM_REACTION_SHARING_H_
#define MECHANISM_CODESIGN_SYSTEM_REACTION_SHARING_H_

#include <vector>

#include "mechanism/topology.h"
#include "system/state.h"

namespace codesign {

/// What becomes of redundant constraints: some rows are dropped, and all rows of the loops they belong to share the reactions with least
/// norm; doc/theory.md (23).
struct ReactionSharing {
  double compliance = 0.0;     ///< epsilon of every row of a joint or coupling, Phi'' - epsilon lambda = 0
  std::vector<int> pairs;      ///< that share, ascending
  std::vector<int> couplings;  ///< that share, ascending
  std::vector<int> dropped;    ///< rows of Phi that follow from the others, of loops and couplings that share

  ReactionSharing() = default;
  /// Compliance alone: no row is dropped.
  ReactionSharing(double epsilon) : compliance(epsilon) {}  // NOLINT(google-explicit-constructor)

  bool drops() const { return !dropped.empty(); }
};

/// Where the unknowns of the sharing stand, behind the multipliers of the constraints: displacements w (7 per body), loads eta (one per
/// row, those of the unit Euler parameters too) and misses mu (one per row that can be dropped).
struct SharingLayout {
  std::vector<int> bodies;     ///< that the sharing pairs and couplings touch, ascending
  std::vector<int> body_slot;  ///< per body; -1 if it takes no part
  std::vector<int> row_slot;   ///< per row of Phi; -1 if it takes no part
  std::vector<int> miss_slot;  ///< per row of Phi; -1 if it cannot be dropped
  int rows = 0, misses = 0;
  int first = 0;  ///< column of the first unknown

  SharingLayout() = default;
  SharingLayout(const ReactionSharing& sharing, const Topology& topology, const Layout& layout);

  int size() const { return 7 * static_cast<int>(bodies.size()) + rows + misses; }
  /// Columns, and rows of the equations.
  int displacement(int body) const { return first + 7 * body_slot[static_cast<std::size_t>(body)]; }
  int load(int row) const { return first + 7 * static_cast<int>(bodies.size()) + row_slot[static_cast<std::size_t>(row)]; }
  int miss(int row) const { return first + 7 * static_cast<int>(bodies.size()) + rows + miss_slot[static_cast<std::size_t>(row)]; }
  bool has_miss(int row) const { return miss_slot[static_cast<std::size_t>(row)] >= 0; }
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SYSTEM_REACTION_SHARING_H_
