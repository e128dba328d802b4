// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_
#define MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_

#include "mechanism_codesign/dynamics/state.h"

namespace codesign {

/// Where an increment's parts stand in one vector [x | v | z | psi] with x = (q, s); sums over stages are then single loops.
struct IncrementLayout {
  int n, states, x_size, z_size;

  explicit IncrementLayout(const Layout& layout)
      : n(layout.n), states(layout.states), x_size(layout.positions()), z_size(layout.columns()) {}

  int x() const { return 0; }
  int s() const { return n; }
  int v() const { return x_size; }
  int z() const { return x_size + n; }
  int sigma() const { return z() + z_size - states; }
  int psi() const { return z() + z_size; }
  int size() const { return psi() + 1; }
};

/// y += the q, v, s and z parts of u.
template <class T>
void add_increment(const IncrementLayout& at, const VectorX<T>& u, State<T>* y) {
  y->q += u.segment(at.x(), at.n);
  y->s += u.segment(at.s(), at.states);
  y->v += u.segment(at.v(), at.n);
  y->z += u.segment(at.z(), at.z_size);
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_INTEGRATION_INCREMENT_H_
