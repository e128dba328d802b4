// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/generic_state.h"

#include <cmath>

namespace codesign {

Eigen::VectorXd waves(Eigen::Index size, double phase) {
  Eigen::VectorXd x(size);
  for (Eigen::Index k = 0; k < size; ++k) x[k] = std::sin(1.7 * static_cast<double>(k) + phase);
  return x;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  return LeastNorm(matrix, 1e-9).solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
}

Eigen::VectorXd allowed(const Eigen::MatrixXd& Phi_q, const Eigen::VectorXd& v) {
  return v - pseudo_inverse(Phi_q) * (Phi_q * v);
}

bool scramble(Compiled* c, double amount) {
  State<double>& state = c->state;
  Eigen::VectorXd Phi, Phi_rate;
  const auto jacobian = [c] { return constraint_jacobian(c->system, &c->equations, c->state); };
  // In small steps along the constraints, so that no turn is lost and no branch is changed.
  for (int step = 0; step < 10; ++step) {
    state.q += 0.1 * amount * allowed(jacobian(), waves(state.q.size(), 0.3));
    for (int iteration = 0; iteration < 8; ++iteration) {
      c->equations.constraint_errors(state, &Phi, &Phi_rate);
      state.q -= pseudo_inverse(jacobian()) * Phi;
    }
    c->equations.track_turns(&state);
  }
  state.v = allowed(jacobian(), waves(state.v.size(), 1.1));
  c->equations.constraint_errors(state, &Phi, &Phi_rate);
  return Phi.norm() < 1e-12 && Phi_rate.norm() < 1e-12 &&
         c->assembly.rates().solve(&c->equations, &state).ok();
}

}  // namespace codesign
