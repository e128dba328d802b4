// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/inverse_dynamics.h"

#include <cassert>

#include "codegen/number_types.h"

namespace codesign {

template <class T>
InverseDynamics<T>::InverseDynamics(const DrivenTree& tree)
    : tree_(tree),
      accelerations_(tree.nodes.size(), T(0.0)),
      rates_(tree.nodes.size(), T(0.0)),
      motions_(tree.nodes.size() + 1),
      adjoints_(tree.nodes.size() + 1) {
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
typename InverseDynamics<T>::Adjoint& InverseDynamics<T>::parent_adjoint(std::size_t k) {
  return node(k).parent < 0 ? adjoints_.back() : adjoints_[static_cast<std::size_t>(node(k).parent)];
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
  m.omega = T(2.0) * (ground_rate_matrix(j.p) * j.pd);
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

template <class T>
void InverseDynamics<T>::append_gradient(const T& factor, SparseGradient<T>* gradient, Out<T> by_acceleration, Out<T> by_rate) {
  for (Adjoint& x : adjoints_) {
    for (Vector3<T>* part : {&x.r, &x.v, &x.omega, &x.omega_rate, &x.acceleration, &x.axis, &x.force, &x.moment}) part->setZero();
    x.W.setZero();
  }
  reverse_sum();
  for (std::size_t k = tree_.nodes.size(); k-- > 0;) {
    if (node(k).pair < 0) continue;
    if (moving_) {
      if (node(k).moved) reverse_weigh(k);
      node(k).slides ? reverse_slide(k) : reverse_turn(k);
      const Adjoint& x = adjoints_[k];
      if (!by_acceleration.empty())
        by_acceleration[static_cast<std::ptrdiff_t>(k)] = dot<T>(motions_[k].axis, node(k).slides ? x.acceleration : x.omega_rate);
      if (node(k).rotor) reverse_rotor(k, by_acceleration, by_rate);
    }
    parent_adjoint(k).W += adjoints_[k].axis * local_axis(k).transpose();
  }
  for (std::size_t k = 0; k < tree_.nodes.size(); ++k) append_body(k, factor, gradient);
}

// Adjoint of the sum axis . sum (moment + (r - P) x force) of a hinge, or axis . sum force of a slide. It sets the adjoints of the forces
// and moments of all bodies that the driven joint moves.
template <class T>
void InverseDynamics<T>::reverse_sum() {
  const Motion& at = motions_[driven()];
  const bool slides = node(driven()).slides;
  Adjoint& joint = adjoints_[driven()];
  Vector3<T> on_point = Vector3<T>::Zero();
  for (std::size_t k = driven(); k < tree_.nodes.size(); ++k) {
    const Motion& m = motions_[k];
    if (slides) {
      joint.axis += m.force;
      adjoints_[k].force = at.axis;
      continue;
    }
    const Vector3<T> lever = body(k).r - parent_body(driven()).r - at.lever_parent;
    joint.axis += m.moment + cross<T>(lever, m.force);
    adjoints_[k].moment = at.axis;
    adjoints_[k].force = cross<T>(at.axis, lever);
    const Vector3<T> on_r = cross<T>(m.force, at.axis);
    adjoints_[k].r += on_r;
    on_point -= on_r;
  }
  if (slides) return;
  parent_adjoint(driven()).r += on_point;
  parent_adjoint(driven()).W += on_point * constants_->pairs[static_cast<std::size_t>(node(driven()).pair)].s_i.transpose();
}

// Adjoint of rotor_load(). It must run before node k hands its adjoint of the axis on to its parent, and before the parent is processed,
// since it adds to the adjoints of both.
template <class T>
void InverseDynamics<T>::reverse_rotor(std::size_t k, Out<T> by_acceleration, Out<T> by_rate) {
  const auto entry = static_cast<std::ptrdiff_t>(k);
  const Motion &m = motions_[k], &parent = parent_motion(k);
  Adjoint &x = adjoints_[k], &up = parent_adjoint(k);
  const T coupling = actuator(k).gear_ratio * actuator(k).rotor_inertia;
  if (!by_rate.empty()) by_rate[entry] = T(0.0);
  if (k == driven()) {
    if (!by_acceleration.empty()) by_acceleration[entry] += coupling * actuator(k).gear_ratio;
    x.axis += coupling * parent.omega_rate;
    up.omega_rate += coupling * m.axis;
    return;
  }
  if (node(driven()).slides) return;
  const Vector3<T> on_moment = coupling * motions_[driven()].axis, swing = cross<T>(parent.omega, m.axis);
  if (!by_acceleration.empty()) by_acceleration[entry] += dot<T>(on_moment, m.axis);
  if (!by_rate.empty()) by_rate[entry] = dot<T>(on_moment, swing);
  x.axis += accelerations_[k] * on_moment + rates_[k] * cross<T>(on_moment, parent.omega);
  up.omega += rates_[k] * cross<T>(m.axis, on_moment);
  adjoints_[driven()].axis += coupling * (accelerations_[k] * m.axis + rates_[k] * swing);
}

// Adjoint of force = m (r'' - g) and moment = J w' + w x J w with J = A J_body A^T.
template <class T>
void InverseDynamics<T>::reverse_weigh(std::size_t k) {
  const Motion& m = motions_[k];
  const BodyConstants<T>& c = mass_of(k);
  const Matrix3<T>& A = body(k).A;
  Adjoint& x = adjoints_[k];
  const auto inertia = [&](const Vector3<T>& y) { return Vector3<T>(c.J * (A.transpose() * y)); };
  const Vector3<T> across = cross<T>(x.moment, m.omega), momentum = A * inertia(m.omega);
  x.acceleration += c.mass * x.force;
  x.omega_rate += A * inertia(x.moment);
  x.omega += A * inertia(across) + cross<T>(momentum, x.moment);
  x.W += x.moment * inertia(m.omega_rate).transpose() + m.omega_rate * inertia(x.moment).transpose() +
         across * inertia(m.omega).transpose() + m.omega * inertia(across).transpose();
}

namespace internal {

/// Adds the adjoints of w, w' and d for the acceleration w' x d + w x (w x d), whose own adjoint is x.
template <class T>
void reverse_carried(const Vector3<T>& omega, const Vector3<T>& omega_rate, const Vector3<T>& d, const Vector3<T>& x, Vector3<T>* on_omega,
                     Vector3<T>* on_omega_rate, Vector3<T>* on_d) {
  const Vector3<T> across = cross<T>(x, omega);
  *on_omega_rate += cross<T>(d, x);
  *on_omega += cross<T>(cross<T>(omega, d), x) + cross<T>(d, across);
  *on_d += cross<T>(x, omega_rate) + cross<T>(across, omega);
}

}  // namespace internal

template <class T>
void InverseDynamics<T>::reverse_turn(std::size_t k) {
  const PairConstants<T>& pair = constants_->pairs[static_cast<std::size_t>(node(k).pair)];
  const Motion &m = motions_[k], &parent = parent_motion(k);
  Adjoint &x = adjoints_[k], &up = parent_adjoint(k);
  Vector3<T> on_lever_parent = Vector3<T>::Zero(), on_lever = Vector3<T>::Zero();
  up.acceleration += x.acceleration;
  internal::reverse_carried(parent.omega, parent.omega_rate, m.lever_parent, x.acceleration, &up.omega, &up.omega_rate, &on_lever_parent);
  internal::reverse_carried(m.omega, m.omega_rate, m.lever, x.acceleration, &x.omega, &x.omega_rate, &on_lever);
  up.omega_rate += x.omega_rate;
  up.omega += cross<T>(m.omega, x.omega_rate);
  x.omega += cross<T>(x.omega_rate, parent.omega);
  x.axis += accelerations_[k] * x.omega_rate;
  up.W += on_lever_parent * pair.s_i.transpose();
  x.W -= on_lever * pair.s_j.transpose();
}

template <class T>
void InverseDynamics<T>::reverse_slide(std::size_t k) {
  const Motion& parent = parent_motion(k);
  const BodyKinematics<T>&i = parent_body(k), &j = body(k);
  Adjoint &x = adjoints_[k], &up = parent_adjoint(k);
  const Vector3<T> arm = j.r - i.r, rate = j.rd - i.rd, across = -cross<T>(x.acceleration, parent.omega);
  const Vector3<T> on_arm = cross<T>(x.acceleration, parent.omega_rate) + cross<T>(across, parent.omega),
                   on_rate = T(2.0) * cross<T>(x.acceleration, parent.omega);
  up.acceleration += x.acceleration;
  up.omega_rate += x.omega_rate + cross<T>(arm, x.acceleration);
  up.omega += T(2.0) * cross<T>(rate, x.acceleration) - cross<T>(cross<T>(parent.omega, arm), x.acceleration) + cross<T>(arm, across);
  x.axis += accelerations_[k] * x.acceleration;
  x.r += on_arm;
  up.r -= on_arm;
  x.v += on_rate;
  up.v -= on_rate;
}

template <class T>
void InverseDynamics<T>::append_body(std::size_t k, const T& factor, SparseGradient<T>* gradient) const {
  const BodyKinematics<T>& b = body(k);
  const Adjoint& x = adjoints_[k];
  const int c = kBodySize * node(k).body;
  Vector4<T> on_p = rotation_hessian_product(x.W, b.p);
  if (moving_) on_p -= T(2.0) * (ground_rate_matrix(b.pd).transpose() * x.omega);
  for (int l = 0; l < 3; ++l) gradient->position.push_back({c + l, T(factor * x.r[l])});
  for (int e = 0; e < 4; ++e) gradient->position.push_back({c + 3 + e, T(factor * on_p[e])});
  if (!moving_) return;
  const Vector4<T> on_pd = T(2.0) * (ground_rate_matrix(b.p).transpose() * x.omega);
  for (int l = 0; l < 3; ++l) gradient->velocity.push_back({c + l, T(factor * x.v[l])});
  for (int e = 0; e < 4; ++e) gradient->velocity.push_back({c + 3 + e, T(factor * on_pd[e])});
}

#define CODESIGN_INSTANTIATE(T) template class InverseDynamics<T>;
CODESIGN_FOR_EACH_NUMBER_TYPE(CODESIGN_INSTANTIATE)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
