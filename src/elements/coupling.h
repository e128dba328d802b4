// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/coordinate_load.h"
#include "elements/state_view.h"

namespace codesign {

// Constraint rows between joint coordinates, Phi = sum of c_k theta_k - b, theory (8a). The row is linear in the coordinates, so its
// multiplier lambda is a load c_k lambda along each of them.

/// Sets the coupling's entries of Phi and Phi_q v. Positions count whole turns.
template <class T>
void coupling_error(const StateView<T>& view, std::size_t k, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  const Coupling& coupling = view.system.topology().couplings[k];
  const CouplingConstants<T>& c = view.design.constants.couplings[k];
  const int row = view.layout.coupling_row(static_cast<int>(k));
  (*Phi)[row] = -c.offset;
  (*Phi_rate)[row] = T(0.0);
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    (*Phi)[row] += c.coefficients[t] * view.coordinate_value(term.pair, term.element);
    (*Phi_rate)[row] += c.coefficients[t] * view.coordinate(term.pair, term.element, CoordinateDetail::kRate).rate;
  }
}

/// epsilon of the coupling's row, theory (23). A drive prescribes a motion exactly, theory (28).
template <class T>
double compliance_in(const StateView<T>& view, const Coupling& coupling) {
  return coupling.is_drive ? 0.0 : view.system.compliance();
}

/// Sets the coupling's row to Phi'' - epsilon lambda and adds J_k^T c_k lambda to the rows of motion.
template <class T>
void coupling_residual(const StateView<T>& view, Workspace<T>* workspace, std::size_t k, VectorX<T>* G) {
  const Coupling& coupling = view.system.topology().couplings[k];
  const int row = view.layout.lambda_column(view.layout.coupling_row(static_cast<int>(k)));
  const T lambda = view.state->z[row];
  (*G)[row] = T(-compliance_in(view, coupling)) * lambda;
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    const T coefficient = view.design.constants.couplings[k].coefficients[t];
    const CoordinateMotion<T>& motion = view.coordinate(term.pair, term.element, CoordinateDetail::kAcceleration);
    (*G)[row] += coefficient * motion.acceleration;
    if (const int c = view.layout.element_column(term.pair, term.element); c >= 0)
      (*G)[c] += coefficient * lambda;
    else
      add_load_on_bodies(view, workspace, term.pair, LocalRow<T>(motion.J * coefficient), lambda, G);
  }
}

}  // namespace codesign
