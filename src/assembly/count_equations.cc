// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/count_equations.h"

#include "assembly/mobility.h"
#include "assembly/redundancy.h"
#include "assembly/start_workspace.h"

namespace codesign {
namespace {

Counts count_absolute(const CompiledSystem& system, const std::vector<double>& parameters, Status* status) {
  const Layout& layout = system.layout();
  Counts counts;
  counts.bodies = layout.bodies;
  counts.coordinates = layout.n;
  counts.first_order_equations = 2 * layout.n;
  counts.controller_states = layout.states;
  counts.constraints = layout.constraints();
  counts.parameters = static_cast<int>(system.study().tuned.size());
  StartWorkspace start(system, parameters);
  *status = start.solve();
  if (status->code == StatusCode::kAssemblyFailed) return counts;
  const Redundancy redundancy = analyse_redundancy(system, &start.equations, start.assembly, parameters, start.state);
  counts.redundant_rows = redundancy.rows;
  counts.undetermined_reactions = redundancy.undetermined;
  counts.chosen_friction = redundancy.friction_chosen;
  counts.redundant_constraints = static_cast<int>(counts.redundant_rows.size());
  counts.degrees_of_freedom = layout.n - (counts.constraints - counts.redundant_constraints);
  if (redundancy.rows.size() > redundancy.sharing.dropped.size())
    counts.degrees_of_freedom -= motions_lost_to_curvature(parameters, start.assembly, start.equations);
  counts.dynamic_equations = counts.first_order_equations + counts.constraints;
  counts.sensitivities = counts.parameters * counts.dynamic_equations;
  counts.total_equations = counts.dynamic_equations + counts.sensitivities;
  return counts;
}

}  // namespace

// The paper's counts are those of absolute coordinates.
Counts count_equations(const CompiledSystem& system, const std::vector<double>& parameters, Status* status) {
  const Layout& layout = system.layout();
  Counts counts;
  if (layout.has_forest()) {
    Study study = system.study();
    study.solver.coordinates = CoordinatesKind::kAbsolute;
    counts = count_absolute(CompiledSystem(system.robot(), study), parameters, status);
  } else {
    counts = count_absolute(system, parameters, status);
  }
  counts.in_joint_coordinates = layout.has_forest();
  counts.solved_coordinates = layout.n;
  counts.solved_constraints = layout.constraints();
  return counts;
}

}  // namespace codesign
