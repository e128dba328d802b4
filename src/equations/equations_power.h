// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_POWER_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_POWER_H_

#include "equations/equations.h"
#include "equations/equations_springs.h"

namespace codesign {

// Powers, theory (14c). A load against a coordinate takes load times rate.

template <class T>
T Equations<T>::power(PowerKind kind, SparseGradient<T>* gradient) {
  T sum(0.0);
  for (const JointLoad& load : system_.loads()) sum += load_power(kind, load, gradient);
  if (kind == PowerKind::kFriction)
    for (int pair : system_.contacts()) sum += contact_power(pair, gradient);
  if (kind == PowerKind::kDamping)
    for (std::size_t k = 0; k < constants_.springs.size(); ++k) sum += spring_power(k, gradient);
  if (kind == PowerKind::kLoad)
    for (std::size_t k = 0; k < system_.link_loads().size(); ++k) sum += link_load_power(k, gradient);
  return sum;
}

template <class T>
T Equations<T>::joint_power(PowerKind kind, int pair, int element, SparseGradient<T>* gradient) {
  const Pair& p = system_.topology().pairs[static_cast<std::size_t>(pair)];
  const auto elements = static_cast<int>(p.chain.size());
  T sum(0.0);
  // A cylindrical loop is one joint with a second coordinate behind those of its chain.
  for (const JointLoad& load : system_.loads())
    if (load.pair == pair && (load.element == element || load.element >= elements)) sum += load_power(kind, load, gradient);
  const bool holds_friction = p.chain[static_cast<std::size_t>(element)].joint == p.friction_joint;
  if (kind == PowerKind::kFriction && holds_friction && slips_isotropically(p.kind)) sum += contact_power(pair, gradient);
  return sum;
}

template <class T>
T Equations<T>::load_power(PowerKind kind, const JointLoad& load, SparseGradient<T>* gradient) {
  const bool acts = kind == PowerKind::kFriction   ? load.reaction_friction || load.constant_friction
                    : kind == PowerKind::kDamping  ? load.passive || load.stop
                    : kind == PowerKind::kActuator ? !load.controllers.empty()
                                                   : !load.constant.empty();
  if (!acts) return T(0.0);
  const CoordinateDetail detail = !gradient                                              ? CoordinateDetail::kRate
                                  : kind == PowerKind::kDamping && load.needs_position() ? CoordinateDetail::kAll
                                                                                         : CoordinateDetail::kGradient;
  // A copy: controllers may ask for other coordinates, and for this one in more detail.
  const CoordinateMotion<T> motion = coordinate(load.pair, load.element, detail);
  const auto before = mark(gradient);
  const T value = load_of(kind, load, motion, gradient);
  if (gradient) {
    gradient->scale_from(before, -motion.rate);
    append_rate(load.pair, load.element, motion, -value, gradient);
  }
  return -value * motion.rate;
}

template <class T>
T Equations<T>::load_of(PowerKind kind, const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient) {
  // A part without the lists of the whole takes no memory.
  JointLoad part;
  part.pair = load.pair;
  part.element = load.element;
  switch (kind) {
    case PowerKind::kFriction:
      part.reaction_friction = load.reaction_friction;
      part.constant_friction = load.constant_friction;
      return joint_load(part, motion, gradient);
    case PowerKind::kDamping: {
      part.passive = load.passive;
      T value = joint_load(part, motion, gradient);
      return load.stop ? T(value + stop_dissipation(load, motion, gradient)) : value;
    }
    case PowerKind::kActuator: {
      const auto before = mark(gradient);
      const T value = applied_effort(load, gradient);
      if (gradient) gradient->scale_from(before, T(-1.0));
      return -value;
    }
    case PowerKind::kLoad:
      break;
  }
  return -constant_effort(load);
}

template <class T>
T Equations<T>::contact_power(int pair, SparseGradient<T>* gradient) {
  const ContactFriction<T> c = contact(pair, gradient ? CoordinateDetail::kGradient : CoordinateDetail::kRate);
  for (std::size_t k = 0; gradient && k < c.size; ++k) {
    append_contact_load(pair, c, k, T(-c.motion[k].rate), gradient);
    append_slip_rate(pair, c, k, T(-c.load[static_cast<Eigen::Index>(k)]), gradient);
  }
  return -c.power();
}

// The damper alone: c l' against l'.
template <class T>
T Equations<T>::spring_power(std::size_t k, SparseGradient<T>* gradient) const {
  using std::sqrt;
  const SpringDamperConstants<T>& c = constants_.springs[k];
  const VectorMotion<T> d = displacement_motion(body(c.body_i), c.s_i, body(c.body_j), c.s_j);
  const T inverse = T(1.0) / sqrt(dot<T>(d.x, d.x) + T(kSpringSmoothing * kSpringSmoothing));
  const Vector3<T> e = inverse * d.x;
  const T rate = dot<T>(e, d.xd);
  if (gradient) {
    const T factor = T(-2.0) * c.damping * rate;
    const Vector3<T> by_d = (factor * inverse) * (d.xd - rate * e), by_rate = factor * e;
    for (const internal::SpringEnd<T>& end : spring_ends(k)) {
      end.append(end.D, by_d, &gradient->position);
      end.append(end.Dd, by_rate, &gradient->position);
      end.append(end.D, by_rate, &gradient->velocity);
    }
  }
  return -c.damping * rate * rate;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_POWER_H_
