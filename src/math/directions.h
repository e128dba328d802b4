// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "math/scalar.h"

namespace codesign {

// The derivatives that a vector of complex numbers (imaginary parts) or of lanes carries, as a real matrix: one row per component, one
// column per direction. The derivatives of a solution of equations follow from a linear solve with this matrix on the right-hand side
// (implicit function theorem).

/// The derivatives of x: x.size() x 1 for complex numbers, x.size() x N for lanes. @param d resized and filled.
inline void directions_of(const VectorX<std::complex<double>>& x, Eigen::MatrixXd* d) { *d = x.imag(); }
template <int N>
void directions_of(const VectorX<Lanes<N>>& x, Eigen::MatrixXd* d) {
  d->resize(x.size(), N);
  for (Eigen::Index k = 0; k < x.size(); ++k) d->row(k) = x[k].directions().transpose();
}
template <class T>
Eigen::MatrixXd directions_of(const VectorX<T>& x) {
  Eigen::MatrixXd d;
  directions_of(x, &d);
  return d;
}

/// Adds d, of the shape of directions_of(*x), to the derivatives of x.
inline void add_directions(const Eigen::MatrixXd& d, VectorX<std::complex<double>>* x) {
  for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k] += std::complex<double>(0.0, d(k, 0));
}
template <int N>
void add_directions(const Eigen::MatrixXd& d, VectorX<Lanes<N>>* x) {
  for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k].directions() += d.row(k).transpose();
}

}  // namespace codesign
