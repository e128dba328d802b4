// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/inverse_dynamics.h"

#include <cassert>

#include "codegen/number_types.h"

namespace codesign {

template <class T>
InverseDynamics<T>::InverseDynamics(const DrivenTree& tree)
    : tree_(tree), accelerations_(tree.nodes.size(), T(0.0)), rates_(tree.nodes.size(), T(0.0)), motions_(tree.nodes.size() + 1) {
  for (Motion& m : motions_)
    for (Vector3<T>* x : {&m.omega, &m.omega_rate, &m.acceleration, &m.axis, &m.lever_parent, &m.lever, &m.force, &m.moment}) x->setZero();
}

template <class T>
const BodyKinematics<T>& InverseDynamics<T>::parent_body(std::size_t k) const {
  return node(k).parent < 0 ? bodies_->back() : body(static_cast<std::size_t>(node(k).parent));
}

template <class T>
const typename InverseDynamics<T>::Motion& InverseDynamics<T>::parent_motion(std::size_t k) const {
  return node(k).parent < 0 ? motions_.back() : motions_[static_cast<std::size_t>(node(k).parent)];
}

template <class T>
Vector3<T> InverseDynamics<T>::local_axis(std::size_t k) const {
  const PairConstants<T>& pair = constants_->pairs[static_cast<std::size_t>(node(k).pair)];
  return node(k).slides ? pair.coordinates[0].a : Vector3<T>(pair.C_i.col(2));
}

template <class T>
T InverseDynamics<T>::load(const Constants<T>& constants, const std::vector<BodyKinematics<T>>& bodies, const Vector3<T>& gravity,
                           In<T> accelerations, In<T> rates) {
  assert(accelerations.empty() || accelerations.size() == static_cast<std::ptrdiff_t>(accelerations_.size()));
  assert(rates.empty() || rates.size() == static_cast<std::ptrdiff_t>(rates_.size()));
  constants_ = &constants;
  bodies_ = &bodies;
  moving_ = !accelerations.empty();
  if (moving_) accelerations_.assign(accelerations.begin(), accelerations.end());
  if (moving_ && !rates.empty()) rates_.assign(rates.begin(), rates.end());
  Vector3<T> force = Vector3<T>::Zero(), moment = Vector3<T>::Zero();
  T rotors(0.0);
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) {
    if (moving_ || k == driven()) move(k, accelerations_[k]);
    if (!node(k).moved) continue;
    weigh(k, gravity);
    const Motion& at = motions_[driven()];
    force += motions_[k].force;
    const Vector3<T> lever = body(k).r - parent_body(driven()).r - at.lever_parent;
    moment += motions_[k].moment + cross<T>(lever, motions_[k].force);
    if (moving_ && node(k).rotor) rotors += rotor_load(k);
  }
  return dot<T>(motions_[driven()].axis, node(driven()).slides ? force : moment) + rotors;
}

// The driven joint turns its own rotor over the gear. Rotors of other joints, carried by bodies that it moves, need the rate h' of their
// angular momentum, theory (9a), as a moment; a slide transmits no moment along its coordinate.
template <class T>
T InverseDynamics<T>::rotor_load(std::size_t k) const {
  const Motion& m = motions_[k];
  const T coupling = actuator(k).gear_ratio * actuator(k).rotor_inertia;
  if (k == driven()) return coupling * (actuator(k).gear_ratio * accelerations_[k] + dot<T>(m.axis, parent_motion(k).omega_rate));
  if (node(driven()).slides) return T(0.0);
  const Vector3<T> moment = accelerations_[k] * m.axis + rates_[k] * cross<T>(parent_motion(k).omega, m.axis);
  return coupling * dot<T>(motions_[driven()].axis, moment);
}

template <class T>
void InverseDynamics<T>::move(std::size_t k, const T& acceleration) {
  const PairConstants<T>& pair = constants_->pairs[static_cast<std::size_t>(node(k).pair)];
  const Motion& parent = parent_motion(k);
  const BodyKinematics<T>&i = parent_body(k), &j = body(k);
  Motion& m = motions_[k];
  m.axis = i.A * local_axis(k);
  m.lever_parent = i.A * pair.s_i;
  if (!moving_) return;
  m.omega = ground_omega(j);
  if (node(k).slides) {
    const Vector3<T> arm = j.r - i.r, rate = j.rd - i.rd;
    m.omega_rate = parent.omega_rate;
    m.acceleration = parent.acceleration + cross<T>(parent.omega_rate, arm) + T(2.0) * cross<T>(parent.omega, rate) -
                     cross<T>(parent.omega, cross<T>(parent.omega, arm)) + m.axis * acceleration;
    return;
  }
  m.lever = -(j.A * pair.s_j);
  m.omega_rate = parent.omega_rate + cross<T>(parent.omega, m.omega) + m.axis * acceleration;
  m.acceleration = parent.acceleration + cross<T>(parent.omega_rate, m.lever_parent) +
                   cross<T>(parent.omega, cross<T>(parent.omega, m.lever_parent)) + cross<T>(m.omega_rate, m.lever) +
                   cross<T>(m.omega, cross<T>(m.omega, m.lever));
}

template <class T>
void InverseDynamics<T>::weigh(std::size_t k, const Vector3<T>& gravity) {
  Motion& m = motions_[k];
  const BodyConstants<T>& c = mass_of(k);
  if (!moving_) {
    m.force = -c.mass * gravity;
    return;
  }
  const Matrix3<T>& A = body(k).A;
  const Vector3<T> rate = A.transpose() * m.omega_rate, omega = A.transpose() * m.omega;
  const Vector3<T> turning = A * (c.J * rate), momentum = A * (c.J * omega);
  m.force = c.mass * (m.acceleration - gravity);
  m.moment = turning + cross<T>(m.omega, momentum);
}

#define CODESIGN_INSTANTIATE(T) template class InverseDynamics<T>;
CODESIGN_FOR_EACH_FORMULA_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
