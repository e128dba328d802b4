// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that carry derivatives through a solution, doc/theory.md (20).
#include <algorithm>

#include "assembly/assembly.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

template <class T>
void Assembly::correct(const Dependents& dependents, const VectorX<T>& rows,
                       ExtensionWorkspace<T>* workspace, VectorX<T>* coordinates) const {
  ExtensionWorkspace<T>& w = *workspace;
  directions_of(rows, &w.errors);
  loops_.take_part(w.errors, &w.rows);
  const Eigen::MatrixXd& step = dependents.solve(w.rows, &w.scaled, &w.solution);
  w.changes.setZero(coordinates->size(), step.cols());
  for (std::size_t k = 0; k < dependents.columns.size(); ++k)
    w.changes.row(dependents.columns[k]) = -step.row(to_signed(k));
  add_directions(w.changes, coordinates);
}

template <class T>
void Assembly::extend(const std::vector<T>& parameters, const State<double>& start,
                      Equations<T>* equations, ExtensionWorkspace<T>* workspace,
                      State<T>* state) const {
  ExtensionWorkspace<T>& w = *workspace;
  state->resize(system_.layout());
  state->t = start.t;
  state->turns = start.turns;
  set_extra_states(system_, parameters, &state->s);
  w.theta = theta_.template cast<T>();
  w.rate = theta_rate_.template cast<T>();
  set_given_start(system_, tree_, parameters, posture_, &w.theta, &w.rate);
  const auto place_extended = [&] {
    equations->place(w.theta, w.rate, state);
    equations->constraint_errors(*state, &w.Phi, &w.Phi_rate);
  };
  place_extended();
  correct(positions_, w.Phi, workspace, &w.theta);
  for (const auto& [motor, joint] : tree_.motors) w.theta[motor] = w.theta[joint];
  place_extended();
  correct(velocities_, w.Phi_rate, workspace, &w.rate);
  for (const auto& [motor, joint] : tree_.motors) w.rate[motor] = w.rate[joint];
  place_extended();
  equations->begin_states(state);
  if (!stuck_.is_empty()) extend_stuck(start, equations, workspace, state);
  rates_.extend(start.z, equations, &workspace->rates, state);
}

#define CODESIGN_INSTANTIATE(T)                                                                 \
  template void Assembly::extend<T>(const std::vector<T>&, const State<double>&, Equations<T>*, \
                                    ExtensionWorkspace<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
