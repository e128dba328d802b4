// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/state_view.h"
#include "forces/contact_law.h"
#include "forces/contact_shape.h"
#include "forces/friction_curves.h"
#include "forces/friction_law.h"
#include "math/arrays.h"

namespace codesign {

// Bodies that touch each other, `<codesign:contact>`: gap and normal of each point by the rows of
// the two shapes, theory (13k), the normal force by the row of the law, (13l), friction in the
// plane of contact, (13m). Friction inside of joints, theory (13a), is in elements/contact.h.

/// One point of a contact at the loaded state, in ground axes.
template <class T>
struct TouchPoint {
  T gap{0.0};                              ///< [m], negative by the penetration
  T gap_rate{0.0};                         ///< [m/s]
  Vector3<T> place = Vector3<T>::Zero();   ///< where the forces act [m]
  Vector3<T> normal = Vector3<T>::Zero();  ///< n, from the surface outwards [-]
  /// velocity of the body with the points past the one with the surface, across n [m/s]
  Vector3<T> slip = Vector3<T>::Zero();
};

template <class T>
const ContactDescription& contact_of(const StateView<T>& view, std::size_t k) {
  return view.system.robot().contacts[k];
}

/// The velocity of a body's material at a place in ground axes [m/s].
template <class T>
Vector3<T> velocity_at(const BodyKinematics<T>& body, const Vector3<T>& place) {
  if (body.at_rest) return Vector3<T>::Zero();
  return body.rd + cross<T>(ground_omega(body), Vector3<T>(place - body.r));
}

/// The k-th contact's point: gap, normal and slip. The forces act in the middle of the overlap.
template <class T>
TouchPoint<T> touch_point(const StateView<T>& view, std::size_t k, int index) {
  const ContactConstants<T>& c = view.design.constants.contacts[k];
  const ContactDescription& of = contact_of(view, k);
  const BodyKinematics<T>&i = view.body(c.surface.body), &j = view.body(c.points.body);
  const Matrix3<T> R_i = i.A * c.surface.frame.R, R_j = j.A * c.points.frame.R;
  Vector3<T> towards = Vector3<T>::Zero();
  if (of.points.shape->turns) {
    const Vector3<T> normal =
        of.surface.shape->surface.template of<T>(Vector3<T>(Vector3<T>::Zero()), c.surface.shape)
            .normal;
    towards = -(R_j.transpose() * Vector3<T>(R_i * normal));
  }
  const Vector3<T> in_shape = of.points.shape->point.template of<T>(index, towards, c.points.shape),
                   at = j.r + j.A * c.points.frame.s + R_j * in_shape,
                   origin = i.r + i.A * c.surface.frame.s;
  const SurfaceDistance<T> to = of.surface.shape->surface.template of<T>(
      Vector3<T>(R_i.transpose() * Vector3<T>(at - origin)), c.surface.shape);
  const T radius = of.points.shape->ball ? c.points.shape.radius : T(0.0);
  TouchPoint<T> point;
  point.gap = to.distance - radius;
  point.normal = R_i * to.normal;
  point.place = at - (radius + T(0.5) * point.gap) * point.normal;
  const Vector3<T> velocity = velocity_at(j, point.place) - velocity_at(i, point.place);
  point.gap_rate = dot<T>(point.normal, velocity);
  point.slip = velocity - point.gap_rate * point.normal;
  return point;
}

/// The normal force of one point, theory (13l).
template <class T>
ContactForce<T> touch_force(const StateView<T>& view, std::size_t k, int index,
                            const TouchPoint<T>& point) {
  const ContactDescription& of = contact_of(view, k);
  const NamedSwitches<T> named(view.state->q[0], of);
  return contact_force(*of.model, of.has_loss(), point.gap, point.gap_rate,
                       view.design.constants.contacts[k].force, kContactParts * index);
}

/// The friction on the body with the points, theory (13m) [N]: against the slip.
template <class T>
Vector3<T> touch_friction(const StateView<T>& view, std::size_t k, const TouchPoint<T>& point,
                          const T& normal) {
  const ContactDescription& of = contact_of(view, k);
  if (!of.friction) return Vector3<T>::Zero();
  const FrictionConstants<T>& c = view.design.constants.contacts[k].friction;
  const auto sigma = [&](const T& square) { return per_speed<T>(*of.friction->model, square, c); };
  return -isotropic_friction<T, 3>(point.slip, normal, sigma);
}

/// Calls visit(point, force, friction) for each point that touches.
template <class T, class Visit>
void for_each_touch(const StateView<T>& view, std::size_t k, const Visit& visit) {
  const int points = contact_of(view, k).points.shape->points;
  for (int index = 0; index < points; ++index) {
    const TouchPoint<T> point = touch_point(view, k, index);
    const ContactForce<T> force = touch_force(view, k, index, point);
    if (force.touches) visit(point, force, touch_friction(view, k, point, force.normal));
  }
}

/// Adds the forces of the k-th contact of the model to Workspace::loads. Must be called before
/// body_residual().
template <class T>
void add_body_contact(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
  const ContactConstants<T>& c = view.design.constants.contacts[k];
  const auto add = [&](int body, const Vector3<T>& place, const Vector3<T>& load) {
    BodyLoad<T>* const on_body = workspace->load_on(body);
    if (!on_body) return;
    const BodyKinematics<T>& motion = view.body(body);
    const Vector3<T> s = motion.A.transpose() * Vector3<T>(place - motion.r);
    on_body->force += load;
    on_body->W += load * s.transpose();
  };
  for_each_touch(
      view, k,
      [&](const TouchPoint<T>& point, const ContactForce<T>& force, const Vector3<T>& friction) {
        const Vector3<T> on_points = force.normal * point.normal + friction;
        add(c.points.body, point.place, Vector3<T>(-on_points));
        add(c.surface.body, point.place, on_points);
      });
}

/// The elastic energy of a contact [J], theory (14b).
template <class T>
T body_contact_energy(const StateView<T>& view, std::size_t k) {
  const ContactDescription& of = contact_of(view, k);
  T energy(0.0);
  for (int index = 0; index < of.points.shape->points; ++index)
    energy += contact_energy<T>(*of.model, touch_point(view, k, index).gap,
                                view.design.constants.contacts[k].force);
  return energy;
}

/// The power of friction, or of the part of the normal force that is not elastic [W], theory (14c);
/// never positive.
template <class T>
T body_contact_power(const StateView<T>& view, PowerKind kind, std::size_t k) {
  T power(0.0);
  for_each_touch(
      view, k,
      [&](const TouchPoint<T>& point, const ContactForce<T>& force, const Vector3<T>& friction) {
        if (kind == PowerKind::kFriction) power += dot<T>(friction, point.slip);
        if (kind == PowerKind::kDamping) power += (force.normal - force.elastic) * point.gap_rate;
      });
  return power;
}

// Signals of a contact.

/// The point with the smallest gap.
template <class T>
TouchPoint<T> nearest_point(const StateView<T>& view, int contact) {
  const std::size_t k = to_index(contact);
  TouchPoint<T> nearest = touch_point(view, k, 0);
  for (int index = 1; index < contact_of(view, k).points.shape->points; ++index) {
    const TouchPoint<T> point = touch_point(view, k, index);
    if (takes_all_branches(point.gap)) {
      nearest.gap += point.gap;
      nearest.gap_rate += point.gap_rate;
      nearest.slip += point.slip;
    } else if (is_less(point.gap, nearest.gap, false)) {
      nearest = point;
    }
  }
  return nearest;
}

template <class T>
T contact_normal_force(const StateView<T>& view, int contact) {
  T sum(0.0);
  for_each_touch(view, to_index(contact),
                 [&](const TouchPoint<T>&, const ContactForce<T>& force, const Vector3<T>&) {
                   sum += force.normal;
                 });
  return sum;
}

template <class T>
T contact_friction(const StateView<T>& view, int contact) {
  Vector3<T> sum = Vector3<T>::Zero();
  for_each_touch(view, to_index(contact),
                 [&](const TouchPoint<T>&, const ContactForce<T>&, const Vector3<T>& friction) {
                   sum += friction;
                 });
  return length_of<T, 3>(sum);
}

template <class T>
T contact_slip_speed(const StateView<T>& view, int contact) {
  return length_of<T, 3>(nearest_point(view, contact).slip);
}

}  // namespace codesign
