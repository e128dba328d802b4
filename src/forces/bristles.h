// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/friction_law.h"
#include "forces/friction_numbers.h"
#include "math/euler_parameters.h"
#include "math/scalar.h"

namespace codesign {

/// The factor d in dir(u) = d u, as a function of u.u; doc/theory.md (13e). d = 1/|u| for |u| >=
/// v_e; below, the parabola (3 - u.u/v_e^2)/(2 v_e), which is finite at rest and continues it with
/// the same slope.
/// @param square u.u [m^2/s^2]. @param v_e [m/s]. @return [s/m]
template <class T>
T direction_per_speed(const T& square, const T& v_e) {
  using std::sqrt;
  if (is_less(square, T(v_e * v_e), false)) {
    return T(1.5) / v_e - square * (T(0.5) / (v_e * v_e * v_e));
  }
  return T(1.0) / sqrt(square);
}

/// The decisions of bristles, as parts for name_part(): where the friction is cut off, and where
/// the dwell state turns from growing to falling.
constexpr int kBristleCut = 0, kBristleDwell = 1;

/// x if |x| <= limit, else limit x/|x|; doc/theory.md (13e).
template <class T>
Vector3<T> cut_off(const Vector3<T>& x, const T& limit) {
  using std::sqrt;
  const T square = dot(x, x);
  name_part(square, kBristleCut);
  if (!is_below_kink(T(limit * limit), square, false)) return x;
  return limit * ((T(1.0) / sqrt(square)) * x);
}

/// Friction of Gonthier, McPhee, Lange and Piedboeuf (2004) per unit of normal force, doc/theory.md
/// (13e). A share s = exp(-u.u/v_s^2) of the contact rests and is a spring and a damper (sigma_0,
/// sigma_1); the rest slides. The largest friction grows with the dwell state s_dw from mu_d to
/// mu_s. With zeta = sigma_0 z, c = mu_d dir(u) and f = s (zeta + sigma_1 u) + (1 - s) c:
///   mu = f cut off at mu_d + (mu_s - mu_d) s_dw,
///   zeta' = sigma_0 s u + (1 - s) sigma_0/sigma_1 (c - zeta),
///   s_dw' = (s - s_dw)/tau with tau = tau_dw if s >= s_dw, else sigma_1/sigma_0.
/// mu and the rates are continuous; their derivatives jump where the cut begins and where tau
/// changes.
/// @param u slip velocity [m/s]; with one slip direction only u[0] is used, the others are zero.
template <class T>
Bristle<T> gonthier(const Vector3<T>& u, const BristleState<T>& state,
                    const FrictionConstants<T>& c) {
  using std::exp;
  // V_e / v_s; below it the sliding share 1 - s, and so the direction, is less than 1 %.
  constexpr double kDirectionVelocity = 0.1;
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const T s = exp(-square * v2), left = T(1.0) - s,
          bristle_rate = c.bristle_stiffness / c.bristle_damping;
  const T d = direction_per_speed<T>(square, T(T(kDirectionVelocity) * c.transition_velocity));
  const Vector3<T> sliding = (c.mu_dynamic * d) * u, resting = state.zeta + c.bristle_damping * u;

  Bristle<T> b;
  b.rate = (c.bristle_stiffness * s) * u + (left * bristle_rate) * (sliding - state.zeta);
  b.mu = cut_off<T>(s * resting + left * sliding,
                    T(c.mu_dynamic + (c.mu_static - c.mu_dynamic) * state.dwell));
  name_part(state.dwell, kBristleDwell);
  const T pace = is_below_kink(s, state.dwell, true) ? bristle_rate : T(T(1.0) / c.dwell_time);
  b.dwell_rate = pace * (s - state.dwell);
  return b;
}

/// LuGre friction of Canudas de Wit, Olsson, Astrom and Lischinsky (1995) per unit of normal force,
/// equal in all directions; doc/theory.md (13f):
///   zeta' = sigma_0 (u - |u|/g zeta),   g = mu_d + (mu_s - mu_d) exp(-u.u/v_s^2),
///   mu = zeta + sigma_1/sigma_0 zeta',
/// with zeta = sigma_0 z. In steady sliding |mu| = g. At rest, where |u| has no derivative, its
/// derivative is set to zero. g must not vanish.
/// @param u slip velocity [m/s]; with one slip direction only u[0] is used, the others are zero.
/// The dwell state is not used.
template <class T>
Bristle<T> lugre(const Vector3<T>& u, const BristleState<T>& state, const FrictionConstants<T>& c) {
  using std::exp;
  using std::sqrt;
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const T speed = is_less(T(0.0), square, true) ? T(sqrt(square)) : T(0.0);
  const T g = c.mu_dynamic + (c.mu_static - c.mu_dynamic) * exp(-square * v2);
  const Vector3<T> stretch = u - speed / g * state.zeta;  // zeta' / sigma_0 [m/s]

  Bristle<T> b;
  b.rate = c.bristle_stiffness * stretch;
  b.mu = state.zeta + c.bristle_damping * stretch;
  return b;
}

// Steady sliding, theory (13j). Below V_s the states fall to those at rest, which are zero, so that
// velocities of rounding errors deflect nothing.

/// V_s / v_s.
constexpr double kSteadyVelocity = 1e-3;

/// zeta = g(u) dir(u) of the LuGre law, with the direction of direction_per_speed() for V_s.
template <class T>
BristleState<T> steady_lugre(const Vector3<T>& u, const FrictionConstants<T>& c) {
  using std::exp;
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const T g = c.mu_dynamic + (c.mu_static - c.mu_dynamic) * exp(-square * v2);
  BristleState<T> state;
  state.zeta =
      (g * direction_per_speed<T>(square, T(T(kSteadyVelocity) * c.transition_velocity))) * u;
  return state;
}

/// Of Gonthier's law s_dw = s and zeta = c + sigma_1 s u/(1 - s), where zeta' = 0. Bristles of a
/// slow contact deflect beyond the cut of friction, F: they start with |zeta| = F, where the
/// friction is the same.
template <class T>
BristleState<T> steady_gonthier(const Vector3<T>& u, const FrictionConstants<T>& c) {
  using std::exp;
  using std::sqrt;
  constexpr double kDirectionVelocity = 0.1;  // as in gonthier()
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const T s = exp(-square * v2), left = T(1.0) - s;
  const T pushed = c.mu_dynamic *
                   direction_per_speed<T>(square, T(T(kDirectionVelocity) * c.transition_velocity)),
          direction = direction_per_speed<T>(square, T(T(kSteadyVelocity) * c.transition_velocity));
  BristleState<T> state;
  state.dwell = s * square * direction * direction;
  // F at this dwell state.
  const T most = c.mu_dynamic + (c.mu_static - c.mu_dynamic) * s;
  // zeta = f u: beyond the cut, f |u| > F, it is cut. Without a division by 1 - s, which rounds to
  // zero at low speeds.
  const T rest = left * most * direction - left * pushed, held = c.bristle_damping * s;
  const bool is_cut = !is_less(held, rest, true);
  state.zeta = (is_cut ? T(most * direction) : T(pushed + held / left)) * u;
  return state;
}

/// A contact whose friction has states. In the vector of extra states it has one zeta per slip
/// coordinate, then s_dw if the law has it.
struct BristleContact {
  FrictionModel model = FrictionModel::kGonthier;
  int pair = -1, element = -1;  ///< element -1: the pair slips isotropically
  int first = 0;                ///< index of the first state
  int size = 1;                 ///< number of slip coordinates
  bool gear = false;            ///< the flanks of the coordinate's gear, theory (9b)

  bool dwells() const { return model->dwells; }
  int states() const { return size + (dwells() ? 1 : 0); }
  int dwell_state() const { return first + size; }
};

/// Evaluates the friction law of a contact. @param u slip velocity [m/s]. @param s all extra
/// states, of which it reads its own.
template <class T>
Bristle<T> bristle_law(const BristleContact& contact, const Vector3<T>& u, const VectorX<T>& s,
                       const FrictionConstants<T>& c) {
  const NamedSwitches<T> named(s[contact.first], contact);
  BristleState<T> state;
  for (int k = 0; k < contact.size; ++k) state.zeta[k] = s[contact.first + k];
  if (contact.dwells()) state.dwell = s[contact.dwell_state()];
  return contact.model->bristle.of<T>(u, state, c);
}

}  // namespace codesign
