// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/compliance.h"

namespace codesign {

// Spring-dampers between two points, theory (13b). F acts on body i and -F on body j; it enters the
// equations as the load of a multiplier does, theory (7).

/// The force of the k-th spring-damper of the model at the loaded state.
template <class T>
SpringForce<T> spring_at(const StateView<T>& view, std::size_t k) {
  const SpringDamperConstants<T>& c = view.design.constants.springs[k];
  const VectorMotion<T> d =
      displacement_motion(view.body(c.body_i), c.s_i, view.body(c.body_j), c.s_j);
  return spring_damper<T>(d.x, d.xd, c.stiffness, c.damping, c.free_length);
}

/// Adds the force of a spring-damper to Workspace::loads. Must be called before body_residual().
template <class T>
void add_spring_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k,
                     const SpringForce<T>& force) {
  const SpringDamperConstants<T>& c = view.design.constants.springs[k];
  add_vector_load(PairVector<T>::displacement(c.s_i, c.s_j), force.pull,
                  workspace->load_on(c.body_i), workspace->load_on(c.body_j));
}

/// The elastic energy k (l - l_0)^2/2 of a spring-damper [J].
template <class T>
T spring_energy_at(const StateView<T>& view, std::size_t k) {
  const SpringDamperConstants<T>& c = view.design.constants.springs[k];
  const Vector3<T> d =
      displacement_motion(view.body(c.body_i), c.s_i, view.body(c.body_j), c.s_j).x;
  return codesign::spring_energy<T>(d, c.stiffness, c.free_length);
}

/// The rate l' of the length of a spring-damper [m/s].
template <class T>
T spring_speed(const StateView<T>& view, std::size_t k) {
  using std::sqrt;
  const SpringDamperConstants<T>& c = view.design.constants.springs[k];
  const VectorMotion<T> d =
      displacement_motion(view.body(c.body_i), c.s_i, view.body(c.body_j), c.s_j);
  const T inverse = T(1.0) / sqrt(dot<T>(d.x, d.x) + T(kSpringSmoothing * kSpringSmoothing));
  return dot<T>(Vector3<T>(inverse * d.x), d.xd);
}

/// The power -c l'^2 of the damper [W], never positive.
template <class T>
T spring_power(const StateView<T>& view, std::size_t k) {
  const T rate = spring_speed(view, k);
  return -view.design.constants.springs[k].damping * rate * rate;
}

}  // namespace codesign
