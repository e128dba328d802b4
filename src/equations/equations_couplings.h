// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_COUPLINGS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_COUPLINGS_H_

#include "equations/equations.h"

namespace codesign {

// Rows between joint coordinates, theory (8a). A row is linear in the coordinates, so that its multiplier loads each of them with its own
// coefficient.

template <class T>
void Equations<T>::coupling_error(std::size_t k, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  const Coupling& coupling = system_.topology().couplings[k];
  const CouplingConstants<T>& c = constants_.couplings[k];
  const int row = layout_.coupling_row(static_cast<int>(k));
  (*Phi)[row] = -c.offset;
  (*Phi_rate)[row] = T(0.0);
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    (*Phi)[row] += c.coefficients[t] * coordinate_value(term.pair, term.element);
    (*Phi_rate)[row] += c.coefficients[t] * coordinate(term.pair, term.element, CoordinateDetail::kRate).rate;
  }
}

template <class T>
void Equations<T>::coupling_residual(std::size_t k, VectorX<T>* G) {
  const Coupling& coupling = system_.topology().couplings[k];
  const int row = layout_.lambda_column(layout_.coupling_row(static_cast<int>(k)));
  const T lambda = state_->z[row];
  (*G)[row] = T(-system_.compliance()) * lambda;
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    const T coefficient = constants_.couplings[k].coefficients[t];
    const CoordinateMotion<T>& motion = coordinate(term.pair, term.element, CoordinateDetail::kGradient);
    (*G)[row] += coefficient * motion.acceleration;
    for (int local = 0; local < kLocalSize; ++local)
      if (const int c = column(term.pair, local); c >= 0) (*G)[c] += motion.J[local] * coefficient * lambda;
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_coupling(std::size_t k, Sink* sink) {
  const Coupling& coupling = system_.topology().couplings[k];
  const int row = layout_.lambda_column(layout_.coupling_row(static_cast<int>(k)));
  if (system_.compliance() != 0.0) sink->rate(row, row, T(-system_.compliance()));
  for (std::size_t t = 0; t < coupling.terms.size(); ++t) {
    const CouplingTerm& term = coupling.terms[t];
    const T coefficient = constants_.couplings[k].coefficients[t];
    const CoordinateMotion<T>& motion = coordinate(term.pair, term.element, CoordinateDetail::kGradient);
    const bool with_r = coordinate_moves_r(term.pair, term.element);
    for (int local = 0; local < kLocalSize; ++local) {
      const int c = column(term.pair, local);
      if (c < 0 || (local % kBodySize < 3 && !with_r)) continue;
      sink->position(row, c, T(coefficient * motion.acceleration_q[local]));
      sink->velocity(row, c, T(coefficient * motion.acceleration_v[local]));
      sink->rate(row, c, T(coefficient * motion.J[local]));
      sink->rate(c, row, T(coefficient * motion.J[local]));
    }
    assemble_load_curvature(term.pair, coordinate_constants(term.pair, term.element), coefficient * state_->z[row], sink);
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_COUPLINGS_H_
