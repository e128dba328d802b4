// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LOADS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LOADS_H_

#include "equations/equations.h"
#include "forces/brown_mcphee.h"
#include "forces/normal_force.h"

namespace codesign {

// Loads along joint coordinates. A load L opposes the coordinate, so the equations get + J^T L; a controller's output counts as -L.

template <class T>
const CoordinateMotion<T>& Equations<T>::coordinate(int pair, int element, CoordinateDetail detail) const {
  KnownCoordinate& known = coordinates_[static_cast<std::size_t>(pair)][static_cast<std::size_t>(element)];
  if (known.version == version_ && known.detail >= detail) return known.motion;
  known.version = version_;
  known.detail = detail;
  const Pair& p = system_.topology().pairs[static_cast<std::size_t>(pair)];
  const PairConstants<T>& c = constants_.pairs[static_cast<std::size_t>(pair)];
  const CoordinateConstants<T>& coordinate = c.coordinates[static_cast<std::size_t>(element)];
  known.motion = coordinate_motion(c, coordinate, body(p.body_i), body(p.body_j), detail);
  if (detail == CoordinateDetail::kAll) known.motion.position += whole_turns(pair, element, known.motion.position);
  return known.motion;
}

template <class T>
T Equations<T>::coordinate_value(int pair, int element) const {
  const Pair& p = system_.topology().pairs[static_cast<std::size_t>(pair)];
  const PairConstants<T>& c = constants_.pairs[static_cast<std::size_t>(pair)];
  const T position = coordinate_position(c, c.coordinates[static_cast<std::size_t>(element)], body(p.body_i), body(p.body_j));
  return position + whole_turns(pair, element, position);
}

template <class T>
T Equations<T>::whole_turns(int pair, int element, const T& position) const {
  const auto p = static_cast<std::size_t>(pair), e = static_cast<std::size_t>(element);
  if (constants_.pairs[p].coordinates[e].kind == CoordinateConstants<T>::Kind::kSlide) return T(0.0);
  return nearest_turns(turn_references_[p][e], position);
}

template <class T>
bool Equations<T>::coordinate_moves_r(int pair, int element) const {
  const auto& c = constants_.pairs[static_cast<std::size_t>(pair)].coordinates[static_cast<std::size_t>(element)];
  return c.kind == CoordinateConstants<T>::Kind::kSlide;
}

template <class T>
void Equations<T>::track_turns(const State<T>& state) {
  load(state);
  for (std::size_t p = 0; p < rows_.size(); ++p)
    for (std::size_t e = 0; e < turn_references_[p].size(); ++e)
      turn_references_[p][e] = value_of(coordinate_value(static_cast<int>(p), static_cast<int>(e)));
  ++version_;
}

template <class T>
void Equations<T>::append_local(int pair, const LocalRow<T>& row, const T& factor, bool with_r,
                                typename SparseGradient<T>::Entries* entries) const {
  for (int local = 0; local < kLocalSize; ++local) {
    const int c = column(pair, local);
    if (c < 0 || (local % kBodySize < 3 && !with_r)) continue;
    entries->push_back({c, T(factor * row[local])});
  }
}

template <class T>
void Equations<T>::append_rate(int pair, int element, const CoordinateMotion<T>& motion, const T& factor,
                               SparseGradient<T>* gradient) const {
  const bool with_r = coordinate_moves_r(pair, element);
  append_local(pair, motion.rate_q, factor, with_r, &gradient->position);
  append_local(pair, motion.J, factor, with_r, &gradient->velocity);
}

template <class T>
void Equations<T>::append_acceleration(int pair, int element, const CoordinateMotion<T>& motion, const T& factor,
                                       SparseGradient<T>* gradient) const {
  const bool with_r = coordinate_moves_r(pair, element);
  append_local(pair, motion.acceleration_q, factor, with_r, &gradient->position);
  append_local(pair, motion.acceleration_v, factor, with_r, &gradient->velocity);
  append_local(pair, motion.J, factor, with_r, &gradient->rate);
}

template <class T>
void Equations<T>::append_body_rate(int index, const Vector3<T>& axis, const T& factor, SparseGradient<T>* gradient) const {
  const BodyKinematics<T>& k = body(index);
  const Vector3<T> twice = (T(2.0) * factor) * axis;
  const Vector4<T> by_pd = body_rate_transposed(k.p, twice), by_p = -body_rate_transposed(k.pd, twice);
  for (int e = 0; e < 4; ++e) {
    gradient->velocity.push_back({kBodySize * index + 3 + e, by_pd[e]});
    gradient->position.push_back({kBodySize * index + 3 + e, by_p[e]});
  }
}

template <class T>
void Equations<T>::append_normal_gradient(int pair, const Vector3<T>& F, const Vector3<T>& torque, const T& factor,
                                          SparseGradient<T>* gradient) const {
  const auto& rows = rows_[static_cast<std::size_t>(pair)];
  const int row = layout_.lambda_column(layout_.pair_row[static_cast<std::size_t>(pair)]);
  const auto add = [&](int column, const T& value) { gradient->rate.push_back({column, T(factor * value)}); };
  const PairKind kind = system_.topology().pairs[static_cast<std::size_t>(pair)].kind;
  if (kind == PairKind::kTable || kind == PairKind::kPlanar) {
    add(row, F[2]);
    return;
  }
  int next = 0;
  if (rows.coincident) {
    const int body_i = system_.topology().pairs[static_cast<std::size_t>(pair)].body_i;
    const Vector3<T> in_body = constants_.pairs[static_cast<std::size_t>(pair)].C_i * F, in_ground = body(body_i).A * in_body;
    for (int k = 0; k < 3; ++k) add(row + k, in_ground[k]);
    if (body_i >= 0) {
      const Vector3<T> lambda = state_->z.template segment<3>(row);
      const Vector4<T> by_p = rotation_hessian_product<T>(lambda * in_body.transpose(), body(body_i).p);
      for (int e = 0; e < 4; ++e) gradient->position.push_back({kBodySize * body_i + 3 + e, T(factor * by_p[e])});
    }
    next = 3;
  } else {
    add(row, F[0]);
    add(row + 1, F[1]);
    next = 2;
  }
  if (rows.size() < next + 2) return;
  add(row + next, torque[1]);
  add(row + next + 1, -torque[0]);
  if (rows.size() > next + 2) add(row + next + 2, torque[2]);
}

template <class T>
NormalForce<T> Equations<T>::normal_force(int pair) const {
  const FrictionConstants<T>& c = constants_.pairs[static_cast<std::size_t>(pair)].friction;
  Vector3<T> F, torque;
  reaction(pair, &F, &torque);
  switch (system_.topology().pairs[static_cast<std::size_t>(pair)].kind) {
    case PairKind::kPrismatic:
      return translational_normal_force(F, torque, c);
    case PairKind::kRevolute:
      return revolute_normal_force(F, torque, c);
    case PairKind::kTable:
    case PairKind::kPlanar:
      return planar_normal_force(F, c);
    case PairKind::kSpherical:
      return ball_normal_force(F, c);
    default:
      return pin_normal_force(F, torque, c);
  }
}

template <class T>
T Equations<T>::reaction_friction(int pair, int element, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient,
                                  FrictionState<T>* state) {
  const auto p = static_cast<std::size_t>(pair);
  const FrictionConstants<T>& c = constants_.pairs[p].friction;
  const bool turning = constants_.pairs[p].coordinates[static_cast<std::size_t>(element)].kind == CoordinateConstants<T>::Kind::kTurn;
  const NormalForce<T> N = normal_force(pair);
  const T radius = turning ? c.pin_radius : T(1.0);
  const BristleContact* const bristle = system_.bristle(pair, element);
  Bristle<T> law;
  FrictionCoefficient<T> S;
  if (bristle) {
    law = bristle_law<T>(*bristle, Vector3<T>(radius * motion.rate, T(0.0), T(0.0)), state_->s, c);
    S = {law.mu[0], law.mu_u(0, 0)};
  } else {
    S = brown_mcphee<T>(radius * motion.rate, c.mu_static, c.mu_dynamic, c.transition_velocity);
  }
  if (state) *state = {motion.rate, N.value, T(radius * S.value * N.value + c.viscous * motion.rate)};
  if (gradient) {
    const T slope = radius * radius * S.slope * N.value + c.viscous;
    append_rate(pair, element, motion, slope, gradient);
    append_normal_gradient(pair, N.F, N.torque, T(radius * S.value), gradient);
    const T per_coefficient = radius * N.value;
    if (bristle)
      append_bristle_states(*bristle, per_coefficient * law.mu_zeta.row(0).transpose(), per_coefficient * law.mu_dwell[0], gradient);
  }
  return radius * S.value * N.value + c.viscous * motion.rate;
}

template <class T>
T Equations<T>::passive_load(int pair, int element, const JointLoad& load, const CoordinateMotion<T>& motion,
                             SparseGradient<T>* gradient) const {
  constexpr double kDryTransitionVelocity = 1e-2;  // [m/s or rad/s]: URDF gives none
  const JointDynamicsConstants<T>& d = constants_.pairs[static_cast<std::size_t>(pair)].dynamics[static_cast<std::size_t>(element)];
  T value(0.0), slope(0.0);
  if (load.passive) {
    slope = d.damping + d.spring_damping;
    value = slope * motion.rate;
    if (load.spring) value += d.stiffness * (coordinate_value(pair, element) - d.free_position);
  }
  if (load.constant_friction) {
    const FrictionCoefficient<T> S = brown_mcphee<T>(motion.rate, T(1.0), T(1.0), T(kDryTransitionVelocity));
    value += d.dry_friction * S.value;
    slope += d.dry_friction * S.slope;
  }
  if (gradient) {
    append_rate(pair, element, motion, slope, gradient);
    if (load.spring) append_local(pair, motion.position_q, d.stiffness, coordinate_moves_r(pair, element), &gradient->position);
  }
  return value;
}

template <class T>
T Equations<T>::joint_load(const JointLoad& load, const CoordinateMotion<T>& motion, SparseGradient<T>* gradient) {
  T value(0.0);
  if (load.reaction_friction) value += reaction_friction(load.pair, load.element, motion, gradient, nullptr);
  if (load.passive || load.constant_friction) value += passive_load(load.pair, load.element, load, motion, gradient);
  if (load.stop) value += stop_load(load, motion, system_.study().limits.dissipation, gradient);
  if (!load.constant.empty()) value -= constant_effort(load);
  if (load.controllers.empty()) return value;
  const auto before = mark(gradient);
  value -= applied_effort(load, gradient);
  if (gradient) gradient->scale_from(before, T(-1.0));
  return value;
}

template <class T>
void Equations<T>::load_residual(const JointLoad& load, VectorX<T>* G) {
  const CoordinateMotion<T>& motion = coordinate(load.pair, load.element, CoordinateDetail::kRate);
  const T value = joint_load(load, motion, nullptr);
  for (int local = 0; local < kLocalSize; ++local)
    if (const int c = column(load.pair, local); c >= 0) (*G)[c] += motion.J[local] * value;
}

template <class T>
template <class Sink>
void Equations<T>::assemble_load(const JointLoad& load, Sink* sink) {
  const CoordinateMotion<T>& motion =
      coordinate(load.pair, load.element, load.needs_position() ? CoordinateDetail::kAll : CoordinateDetail::kGradient);
  gradient_.clear();
  const T value = joint_load(load, motion, &gradient_);
  const bool with_r = coordinate_moves_r(load.pair, load.element);
  for (int local = 0; local < kLocalSize; ++local) {
    const int row = column(load.pair, local);
    if (row >= 0 && (local % kBodySize >= 3 || with_r)) add_row(row, motion.J[local], gradient_, sink);
  }
  assemble_load_curvature(load.pair, coordinate_constants(load.pair, load.element), value, sink);
}

template <class T>
template <class Sink>
void Equations<T>::assemble_load_curvature(int index, const CoordinateConstants<T>& coordinate, const T& load, Sink* sink) {
  const Pair& pair = system_.topology().pairs[static_cast<std::size_t>(index)];
  coordinate_load_gradient(constants_.pairs[static_cast<std::size_t>(index)], coordinate, body(pair.body_i), body(pair.body_j), load,
                           [&](int r, int local_column, const T& entry) {
                             const int row = column(index, r), global_column = column(index, local_column);
                             if (row >= 0 && global_column >= 0) sink->position(row, global_column, entry);
                           });
}

template <class T>
FrictionState<T> Equations<T>::friction(int pair, int element) {
  const CoordinateMotion<T>& motion = coordinate(pair, element);
  FrictionState<T> state;
  for (const JointLoad& load : system_.loads()) {
    if (load.pair != pair || load.element != element) continue;
    state.velocity = motion.rate;
    if (load.reaction_friction) reaction_friction(pair, element, motion, nullptr, &state);
    if (load.constant_friction) {
      JointLoad dry = load;
      dry.passive = dry.spring = false;
      state.load += passive_load(pair, element, dry, motion, nullptr);
    }
  }
  return state;
}

template <class T>
T Equations<T>::effort(int pair, int element) {
  T sum(0.0);
  for (const JointLoad& load : system_.loads())
    if (load.pair == pair && load.element == element) sum += applied_effort(load, nullptr);
  return sum;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_LOADS_H_
