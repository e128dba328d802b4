// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "forces/law.h"
#include "math/scalar.h"

namespace codesign {

/// The numbers of the normal force of two bodies that touch; theory (13l).
template <class T>
struct ContactNumbers {
  T stiffness{0.0};    ///< k [N/m^n]
  T exponent{1.0};     ///< n [-]
  T loss{0.0};         ///< lambda [s/m], or c [N s/m] of `linear`; ContactLaw::loss_attribute
  double onset = 0.0;  ///< w [m], far below every penetration that counts
};

/// delta (delta^2 + w^2)^((n - 1)/2) [m^n], for delta > 0 delta^n but for w. It is smooth and odd:
/// where the bodies begin to touch, the second derivative, which derivatives of a step contain, is
/// zero whatever sign rounding gives delta. A step that begins while they touch sees a pull beyond:
/// else one that is long enough to have all its stages behind a thin body would fall through it.
/// @param depth delta [m]. @param exponent n >= 1. @param onset w > 0 [m].
template <class T>
T contact_power(const T& depth, const T& exponent, double onset) {
  using std::exp;
  using std::log;
  return depth * exp(0.5 * (exponent - 1.0) * log(depth * depth + onset * onset));
}

/// The integral of contact_power() by delta from 0 [m^(n+1)].
template <class T>
T contact_power_integral(const T& depth, const T& exponent, double onset) {
  using std::exp;
  using std::log;
  const T above = exponent + 1.0, square = depth * depth + onset * onset;
  return (exp(0.5 * above * log(square)) - exp(above * std::log(onset))) / above;
}

/// What the force depends on at one instant.
template <class T>
struct ContactValues {
  T depth{0.0};    ///< delta, the penetration [m]
  T rate{0.0};     ///< delta' [m/s], positive while the bodies approach
  T elastic{0.0};  ///< k delta^n [N]
  T loss{0.0};     ///< ContactNumbers::loss
};
/// A factor or a force whose sign is that of the normal force: where it falls to zero, the bodies
/// part although they overlap.
template <class T>
using ContactGrowth = T (*)(const ContactValues<T>& x);
/// lambda v_0 [-] for which a body that arrives at v_0 leaves at e v_0, as the law's authors have
/// it. @param e restitution, 0 < e <= 1.
template <class T>
using ContactLoss = T (*)(const T& e);

/// A law of the normal force, one row of the table in contact_law.cc; theory (13l). With
/// is_factor, F = k delta^n growth, else F = growth.
struct ContactLaw {
  const char* name = "";   ///< the value of `<codesign:contact model>`
  const char* title = "";  ///< its name in sentences
  const char* loss_attribute = "dissipation";
  Law<ContactGrowth> growth{};
  Law<ContactLoss> restitution{};  ///< none: a restitution says nothing about the loss
  double exponent = 1.5;           ///< n where the model gives none
  bool has_exponent = true;        ///< whether a model may give it
  bool is_factor = true;           ///< else the force may jump where the bodies touch
};

/// The law of a contact.
class ContactModel : public RowReference<ContactLaw> {
 public:
  using RowReference::RowReference;
  static const ContactModel kHuntCrossley;
};

/// The library's laws of contact.
std::vector<ContactModel> contact_laws();

/// The decisions of a contact, as parts for name_part(): twice the index of its point, and whether
/// bodies that overlap part.
constexpr int kContactTouch = 0, kContactParting = 1, kContactParts = 2;

/// The normal force of one point of a contact.
template <class T>
struct ContactForce {
  bool touches = false;  ///< else all members are zero
  T normal{0.0};         ///< N >= 0 [N]
  T elastic{0.0};        ///< its part k delta^n [N]
};

/// N at a gap, theory (13l); never negative. Touch and parting are switches.
/// @param gap [m], negative by the penetration. @param gap_rate [m/s].
/// @param has_loss whether the contact has a loss at all; without one it cannot part while it
/// overlaps. @param part of the point, for name_part().
template <class T>
ContactForce<T> contact_force(const ContactLaw& law, bool has_loss, const T& gap, const T& gap_rate,
                              const ContactNumbers<T>& c, int part) {
  ContactForce<T> force;
  name_part(gap, part + kContactTouch);
  const T zero(0.0);
  const bool jumps = has_loss && !law.is_factor;
  force.touches = jumps ? is_below(gap, zero, false) : is_below_kink(gap, zero, false);
  if (!force.touches) return force;
  ContactValues<T> x;
  x.depth = -gap;
  x.rate = -gap_rate;
  x.elastic = c.stiffness;
  x.elastic *= law.has_exponent ? contact_power(x.depth, c.exponent, c.onset) : x.depth;
  x.loss = c.loss;
  force.elastic = force.normal = x.elastic;
  if (!has_loss) return force;
  const T growth = law.growth.of<T>(x);
  name_part(gap, part + kContactParting);
  if (!is_below_kink(zero, growth, true)) {
    force.normal = zero;
    return force;
  }
  force.normal = growth;
  if (law.is_factor) force.normal *= x.elastic;
  return force;
}

/// The elastic energy of one point [J]. @param gap [m].
template <class T>
T contact_energy(const ContactLaw& law, const T& gap, const ContactNumbers<T>& c) {
  const T zero(0.0), depth = -gap;
  if (!is_less(gap, zero, false)) return zero;
  if (!law.has_exponent) return 0.5 * c.stiffness * depth * depth;
  return c.stiffness * contact_power_integral(depth, c.exponent, c.onset);
}

}  // namespace codesign
