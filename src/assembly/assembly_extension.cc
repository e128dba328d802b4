// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The parts of Assembly that solve for rates, and that carry derivatives through a solution,
// doc/theory.md (19), (20).
#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/assembly.h"
#include "assembly/friction_jam.h"
#include "assembly/tree_coordinates.h"
#include "equations/compiled_system.h"
#include "equations/iteration_matrix.h"
#include "equations/mass_solution.h"
#include "math/arrays.h"
#include "math/scalar.h"

namespace codesign {

Status Assembly::solve_rates(Equations<double>* equations, State<double>* state) {
  const char* const place = state->t > 0.0 ? "" : " at the start";
  double g = 0.0, previous = std::numeric_limits<double>::infinity();
  // With redundant rows, rounding errors divided by the compliance remain in the reactions that are
  // not unique.
  const double converged = system_.compliance() == 0.0 ? 1e-11 : 1e-7;
  factor_ = nullptr;
  if (system_.begins_explicitly() && equations->mass_factor()) {
    residual_ = state->z;
    if (equations->accelerations(state, &g, &factor_values_) && std::isfinite(state->z.sum())) {
      factor_ = equations->mass_factor();
      return {};
    }
    state->z = residual_;
  }
  const bool apart = system_.has_rates_apart();
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (cancelled()) return {StatusCode::kCancelled, state->t, "cancelled"};
    apart ? equations->rates(*state, &residual_, &g, &derivatives_)
          : equations->residual(*state, &residual_, &g);
    const double error = residual_.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(error))
      return {StatusCode::kNonFinite, state->t,
              std::string("the equations of motion are not finite") + place};
    if (!apart) equations->linearize(*state, &derivatives_);
    if (!matrix_.factor(derivatives_, 0.0, 0.0, 0.0))
      return {StatusCode::kSingularMatrix, state->t,
              "the augmented matrix of the equations of motion is singular"};
    matrix_.lu().solve(residual_);
    const double size = residual_.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() /
                        (1.0 + state->z.cwiseAbs().maxCoeff());
    state->z -= residual_;
    if (size < 1e-15 || (size < converged && size >= 0.5 * previous)) return {};
    previous = size;
  }
  const std::string jam = jam_advice(system_, *state, equations);
  return {StatusCode::kInitialReactionsFailed, state->t,
          std::string("no accelerations and reactions satisfy the equations of motion") + place +
              (jam.empty() ? ": the position may be a singular one; start from another" : ": ") +
              jam};
}

void Assembly::solve_at_rates(Out<double> x) const {
  if (factor_)
    factor_->solve<1>(factor_values_, x);
  else
    matrix_.lu().solve(x);
}

void Assembly::differentiate_rates(const State<double>& at, Equations<double>* equations,
                                   State<double>* rates) {
  VectorX<double> change;
  // G_q, G_v and G_s at the last iterate but one, which the solution differs from by rounding, are
  // there already in the other case.
  if (system_.has_rates_apart()) equations->linearize(at, &derivatives_);
  rates->z.setZero(system_.layout().columns());
  directional_derivative(system_, derivatives_, *rates, &change);
  rates->z = -(change + derivatives_.time).head(rates->z.size());
  solve_at_rates(rates->z);
}

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
  extend_rates(start.z, equations, workspace, state);
}

// First-order solution of G(z) = 0 with the factorization of the last Newton iteration of
// solve_rates().
template <class T>
void Assembly::extend_rates(const VectorX<double>& z, Equations<T>* equations,
                            ExtensionWorkspace<T>* workspace, State<T>* state) const {
  T g(0.0);
  state->z = z.template cast<T>();
  equations->residual(*state, &workspace->G, &g);
  Eigen::MatrixXd& step = workspace->rates;
  directions_of(workspace->G, &step);
  for (auto column : step.colwise()) solve_at_rates(column);
  step = -step;
  add_directions(step, &state->z);
}

#define CODESIGN_INSTANTIATE(T)                                                                 \
  template void Assembly::extend<T>(const std::vector<T>&, const State<double>&, Equations<T>*, \
                                    ExtensionWorkspace<T>*, State<T>*) const;                   \
  template void Assembly::extend_rates<T>(const VectorX<double>&, Equations<T>*,                \
                                          ExtensionWorkspace<T>*, State<T>*) const;
CODESIGN_INSTANTIATE(std::complex<double>)
CODESIGN_INSTANTIATE(Lanes<4>)
CODESIGN_INSTANTIATE(Lanes<8>)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
