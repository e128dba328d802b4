// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SPRINGS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SPRINGS_H_

#include "equations/equations.h"
#include "forces/spring_damper.h"

namespace codesign {

// Spring-dampers between two points, theory (13b). Their pull enters as the load of a multiplier does, theory (7), so that it must be added
// before the bodies are assembled.

template <class T>
SpringForce<T> Equations<T>::spring(std::size_t k) const {
  const SpringDamperConstants<T>& c = constants_.springs[k];
  const VectorMotion<T> d = displacement_motion(body(c.body_i), c.s_i, body(c.body_j), c.s_j);
  return spring_damper<T>(d.x, d.xd, c.stiffness, c.damping, c.free_length);
}

template <class T>
void Equations<T>::add_spring_load(std::size_t k, const SpringForce<T>& force) {
  const SpringDamperConstants<T>& c = constants_.springs[k];
  add_vector_load(PairVector<T>::displacement(c.s_i, c.s_j), force.pull, load_on(c.body_i), load_on(c.body_j));
}

template <class T>
std::array<internal::SpringEnd<T>, 2> Equations<T>::spring_ends(std::size_t k) const {
  const SpringDamperConstants<T>& c = constants_.springs[k];
  return {internal::SpringEnd<T>{c.body_i, body(c.body_i), c.s_i, T(-1.0)}, {c.body_j, body(c.body_j), c.s_j, T(1.0)}};
}

template <class T>
template <class Sink>
void Equations<T>::assemble_spring(std::size_t k, Sink* sink) {
  const Quantity& damping = system_.robot().spring_dampers[k].damping;
  const bool damped = !damping.is_constant() || damping.nominal() != 0.0;
  const SpringForce<T> force = spring(k);
  add_spring_load(k, force);
  const std::array<internal::SpringEnd<T>, 2> ends = spring_ends(k);
  for (const internal::SpringEnd<T>& on : ends) {
    for (const internal::SpringEnd<T>& by : ends) {
      if (on.column < 0 || by.column < 0) continue;
      const Eigen::Matrix<T, 3, kBodySize> pull_q = force.by_d * by.D + force.by_rate * by.Dd, pull_v = force.by_rate * by.D;
      for (int row = 0; row < kBodySize; ++row) {
        for (int column = 0; column < kBodySize; ++column) {
          sink->position(on.column + row, by.column + column, dot<T>(on.D.col(row), pull_q.col(column)));
          if (damped) sink->velocity(on.column + row, by.column + column, dot<T>(on.D.col(row), pull_v.col(column)));
        }
      }
    }
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SPRINGS_H_
