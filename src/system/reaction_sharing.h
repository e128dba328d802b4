// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "math/arrays.h"
#include "mechanism/topology.h"

namespace codesign {

struct Layout;

/// A row of Phi, whatever the coordinates of the system: of a pair or of a coupling.
struct SharedRow {
  int pair = -1, coupling = -1;  ///< one of them is -1
  int within = 0;                ///< of the pair's rows
};

/// How redundant constraints are treated, doc/theory.md (23): which rows are dropped, and which
/// pairs and couplings share the reactions in the solution of least norm. make_system() finds them;
/// without redundancy everything is empty and zero.
struct ReactionSharing {
  /// epsilon [1/kg] in every row of a joint or coupling, Phi'' - epsilon lambda = 0
  double compliance = 0.0;
  /// pairs that share reactions, ascending; they have rows in all coordinates
  std::vector<int> pairs;
  std::vector<int> couplings;      ///< couplings that share reactions, ascending
  std::vector<SharedRow> dropped;  ///< dropped rows, among the loops and couplings above

  ReactionSharing() = default;
  /// A compliance alone; no row is dropped.
  ReactionSharing(double epsilon) : compliance(epsilon) {}  // NOLINT(google-explicit-constructor)

  bool drops() const { return !dropped.empty(); }
};

/// The places of the unknowns of (23b) in z, after the multipliers of the constraints:
/// displacements w (7 per body), then loads eta (one per row that shares, the rows |p| = 1 of its
/// bodies included), then mu (one per row that can be dropped; called miss in the code, since it
/// takes the violation of a dropped row). The equations of each have the same places in G. All
/// members are empty or zero if no row is dropped.
struct SharingLayout {
  std::vector<int> bodies;     ///< free bodies of the pairs and couplings that share, ascending
  std::vector<int> body_slot;  ///< per body: its index in `bodies`; -1 if it is not among them
  std::vector<int> row_slot;   ///< per row of Phi: its index among the eta; -1 if it does not share
  /// per row of Phi: its index among the mu; -1 if it cannot be dropped
  std::vector<int> miss_slot;
  int rows = 0, misses = 0;  ///< numbers of eta and of mu
  int first = 0;             ///< column of the first unknown

  SharingLayout() = default;
  SharingLayout(const ReactionSharing& sharing, const Topology& topology, const Layout& layout);

  int size() const { return 7 * static_cast<int>(bodies.size()) + rows + misses; }
  /// Columns in z, and rows in G, of the first w of a body, and of eta and mu of a row of Phi.
  int displacement(int body) const { return first + 7 * body_slot[to_index(body)]; }
  int load(int row) const {
    return first + 7 * static_cast<int>(bodies.size()) + row_slot[to_index(row)];
  }
  int miss(int row) const {
    return first + 7 * static_cast<int>(bodies.size()) + rows + miss_slot[to_index(row)];
  }
  bool has_miss(int row) const { return miss_slot[to_index(row)] >= 0; }
};

}  // namespace codesign
