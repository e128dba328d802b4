// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/derivatives.h"
#include "equations/formulas.h"
#include "sparse/sparsity.h"
#include "system/state.h"
#include "system/system.h"

namespace codesign {

/// The equations of one mechanism, evaluated with the scalar that records. The constructor makes
/// the leaves: q, v, s and z (arrays EquationArrays::kQ to kZ), turn references (kTurns) and
/// expressions of the design; functions of time follow where they are used.
struct EquationRecorder {
  static constexpr int kTurns = Recording::kTimed + 1;

  /// @param system and `recording` must outlive this.
  EquationRecorder(const System& system, Recording* recording);

  /// Records q and v at tree coordinates, TreeLayout, and their rates, which are the leaves of kQ
  /// and kV here.
  std::vector<VectorX<Traced>> record_placement();
  /// Records stuck_slips().
  std::vector<VectorX<Traced>> record_stuck_slips();
  /// Records Formulas::track_turns(), without the flags of dropped rows, which no step changes.
  std::vector<VectorX<Traced>> record_turns();
  /// Records G and g, theory (14), (21).
  void record_residual() { formulas.residual(state, &G, &g); }

  Recording* const recording;
  Formulas<Traced> formulas;
  State<Traced> state;
  VectorX<Traced> G;  ///< after record_residual()
  Traced g;           ///< after record_residual()
};

/// A recording that begins with the residual. @param outcomes, mode as of EquationVariant.
struct ResidualRecording {
  explicit ResidualRecording(const System& system, std::vector<bool> outcomes = {},
                             std::vector<bool> mode = {});

  Recording recording;
  EquationRecorder equations;
  bool ends_run = false;      ///< whether the condition of Study::until holds
  std::size_t of_design = 0;  ///< decisions that were made before the residual's
};

/// The gradients of recorded numbers by the state and the time; JacobianEntry::column counts (q,
/// s), v, z and t side by side.
std::vector<JacobianEntry> derive_gradients(const System& system, const std::vector<Traced>& values,
                                            EliminationOrder order, Recording* recording);

/// G_q and G_s, G_v, G_z and G_t, and in one more row the same derivatives of g, derived from the
/// recorded residual alone; theory (14).
/// @param patterns of the result, of record_patterns(). @param order of the elimination. @param
/// rates_only derives G_z alone; the other entries are zero. @param recorded nodes are appended to
/// its recording.
/// @throws std::logic_error for a derivative that is not in the patterns.
Linearization<Traced> derive_linearization(const ByVariable<Sparsity>& patterns,
                                           EliminationOrder order, bool rates_only,
                                           EquationRecorder* recorded);

/// The patterns of the derivatives of G and, in one more row, of the integrand g: entry (row,
/// column) is there if the recorded row depends on the column's variable in some branch. Columns:
/// Layout::positions() of (q, s), Layout::n of v, Layout::columns() of z.
/// @param expected every decision of it has its expected outcome.
ByVariable<Sparsity> record_patterns(const System& system, const ResidualRecording& expected);

}  // namespace codesign
