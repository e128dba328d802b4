// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "equations/compiled_system.h"
#include "mechanism_codesign/status.h"

namespace codesign {

/// Starts the runs of an integrator, each with the pivots that are chosen at the study's own start. The last bits of a run then depend on
/// its design alone, and pivots need not be chosen for each run. See doc/decisions/0049-journal.md.
class SettledStart {
 public:
  /// Before the first run, unless it is the study's own, the study's own start is begun and settled.
  /// @param parameters of this run. @param begin (parameters) -> Status: assembles the start, which factors the matrices.
  /// @param settle () -> keeps their present pivots, SparseLu::settle().
  /// @returns the status of begin(parameters).
  template <class Begin, class Settle>
  Status start(const CompiledSystem& system, const std::vector<double>& parameters, const Begin& begin, const Settle& settle) {
    const bool is_first = !has_settled_, is_own = is_first && parameters == system.parameters();
    has_settled_ = true;
    if (is_first && !is_own && begin(system.parameters()).ok()) settle();
    Status status = begin(parameters);
    if (is_own && status.ok()) settle();
    return status;
  }

 private:
  bool has_settled_ = false;  ///< whether the study's own start was begun
};

}  // namespace codesign
