// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Assembly that carries derivatives through a solution, doc/theory.md (20).
#include <complex>

#include "assembly/assembly_parts.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {
namespace {

/// Adds to the coordinates the derivatives with which the loops' rows keep the value zero, whose
/// derivatives at fixed dependent coordinates `rows` have.
template <class T>
void correct(const LoopJacobian& loops, const DependentSolution& dependents, const VectorX<T>& rows,
             ExtensionWorkspace<T>* workspace, VectorX<T>* coordinates) {
  ExtensionWorkspace<T>& w = *workspace;
  directions_of(rows, &w.errors);
  loops.take_part(w.errors, &w.rows);
  const Eigen::MatrixXd& step = dependents.solve(w.rows, &w.scaled, &w.solution);
  w.changes.setZero(coordinates->size(), step.cols());
  for (std::size_t k = 0; k < dependents.columns.size(); ++k)
    w.changes.row(dependents.columns[k]) = -step.row(to_signed(k));
  add_directions(w.changes, coordinates);
}

}  // namespace

template <class T>
void Assembly::extend(const std::vector<T>& parameters, const State<double>& start,
                      Equations<T>* equations, ExtensionWorkspace<T>* workspace,
                      State<T>* state) const {
  const Parts& parts = *parts_;
  const CompiledSystem& system = parts.loops.system;
  const TreeLayout& tree = parts.loops.tree;
  const LoopJacobian& loops = parts.loops.jacobian;
  ExtensionWorkspace<T>& w = *workspace;
  state->resize(system.layout());
  state->t = start.t;
  state->turns = start.turns;
  set_extra_states(system, parameters, &state->s);
  w.theta = parts.posture.theta.template cast<T>();
  w.rate = parts.posture.rate.template cast<T>();
  set_given_start(system, tree, parameters, parts.posture.number, &w.theta, &w.rate);
  const auto place_extended = [&] {
    equations->place(w.theta, w.rate, state);
    equations->constraint_errors(*state, &w.Phi, &w.Phi_rate);
  };
  place_extended();
  correct(loops, parts.dependents.positions, w.Phi, workspace, &w.theta);
  for (const auto& [motor, joint] : tree.motors) w.theta[motor] = w.theta[joint];
  place_extended();
  correct(loops, parts.dependents.velocities, w.Phi_rate, workspace, &w.rate);
  for (const auto& [motor, joint] : tree.motors) w.rate[motor] = w.rate[joint];
  place_extended();
  equations->begin_states(state);
  parts.stuck.extend(start, parts.rates, equations, workspace, state);
  parts.rates.extend(start.z, equations, &workspace->rates, state);
}

#define CODESIGN_INSTANTIATE(T)                                                                 \
  template void Assembly::extend<T>(const std::vector<T>&, const State<double>&, Equations<T>*, \
                                    ExtensionWorkspace<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
