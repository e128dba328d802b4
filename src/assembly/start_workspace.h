// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"

namespace codesign {

/// The workspace of one analysis at t = 0: a design, its equations, an Assembly and the state that the Assembly computes. Not thread-safe.
struct StartWorkspace {
  /// @param system must outlive the workspace.
  /// @param design all named parameters (Study::parameters order).
  StartWorkspace(const CompiledSystem& system, std::vector<double> design)
      : parameters(std::move(design)), equations(system), assembly(system) {
    equations.compiled().allow(false);  // recording and compiling takes longer than the few evaluations at t = 0
    equations.set_design(parameters);
  }

  /// The functions of Assembly of the same name, for this design; they fill `state`.
  Status solve_positions() { return assembly.solve_positions(parameters, &equations, &state); }
  Status solve_velocities() { return assembly.solve_velocities(parameters, &equations, &state); }
  Status solve_motion() { return assembly.solve_motion(parameters, &equations, &state); }
  Status solve() { return assembly.solve(parameters, &equations, &state); }

  const std::vector<double> parameters;  ///< the design
  Equations<double> equations;
  Assembly assembly;
  State<double> state;
};

}  // namespace codesign
