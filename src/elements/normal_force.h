// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_NORMAL_FORCE_H_
#define MECHANISM_CODESIGN_ELEMENTS_NORMAL_FORCE_H_

#include "elements/gradient_rows.h"
#include "elements/state_view.h"
#include "forces/normal_force.h"

namespace codesign {

// The normal force that a joint's reaction makes in its bearing; theory (12).

template <class T>
void pair_reaction(const StateView<T>& view, int pair, Vector3<T>* F, Vector3<T>* torque) {
  const PairKind kind = view.system.topology().pairs[static_cast<std::size_t>(pair)].kind;
  const int row = view.layout.lambda_column(view.layout.pair_row[static_cast<std::size_t>(pair)]);
  const auto lambda = [&view, row](int k) { return view.state->z[row + k]; };
  F->setZero();
  torque->setZero();
  const auto& rows = view.design.rows[static_cast<std::size_t>(pair)];
  int next = 0;
  if (rows.coincident) {
    const PairConstants<T>& c = view.design.constants.pairs[static_cast<std::size_t>(pair)];
    const Vector3<T> on_child = view.state->z.template segment<3>(row);
    *F = c.C_i.transpose() * (view.body(view.system.topology().pairs[static_cast<std::size_t>(pair)].body_i).A.transpose() * on_child);
    next = 3;
  } else if (kind == PairKind::kPrismatic || kind == PairKind::kCylindrical) {
    *F = Vector3<T>(lambda(0), lambda(1), T(0.0));
    next = 2;
  } else if (kind == PairKind::kTable || kind == PairKind::kPlanar) {
    (*F)[2] = lambda(0);
    next = 1;
  }
  if (kind == PairKind::kUniversal || kind == PairKind::kDistance || rows.size() < next + 2) return;
  (*torque)[1] = lambda(next);
  (*torque)[0] = -lambda(next + 1);
  if (rows.size() > next + 2) (*torque)[2] = lambda(next + 2);
}

template <class T>
void append_normal_gradient(const StateView<T>& view, int pair, const Vector3<T>& F, const Vector3<T>& torque, const T& factor,
                            OptionalGradient<T> gradient) {
  const auto& rows = view.design.rows[static_cast<std::size_t>(pair)];
  const int row = view.layout.lambda_column(view.layout.pair_row[static_cast<std::size_t>(pair)]);
  const auto add = [&](int column, const T& value) { gradient->rate.push_back({column, T(factor * value)}); };
  const PairKind kind = view.system.topology().pairs[static_cast<std::size_t>(pair)].kind;
  if (kind == PairKind::kTable || kind == PairKind::kPlanar) {
    add(row, F[2]);
    return;
  }
  int next = 0;
  if (rows.coincident) {
    const int body_i = view.system.topology().pairs[static_cast<std::size_t>(pair)].body_i;
    const Vector3<T> in_body = view.design.constants.pairs[static_cast<std::size_t>(pair)].C_i * F,
                     in_ground = view.body(body_i).A * in_body;
    for (int k = 0; k < 3; ++k) add(row + k, in_ground[k]);
    if (body_i >= 0) {
      const Vector3<T> lambda = view.state->z.template segment<3>(row);
      const Vector4<T> by_p = rotation_hessian_product<T>(lambda * in_body.transpose(), view.body(body_i).p);
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
NormalForce<T> normal_force(const StateView<T>& view, int pair) {
  const FrictionConstants<T>& c = view.design.constants.pairs[static_cast<std::size_t>(pair)].friction;
  Vector3<T> F, torque;
  pair_reaction(view, pair, &F, &torque);
  switch (view.system.topology().pairs[static_cast<std::size_t>(pair)].kind) {
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

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_NORMAL_FORCE_H_
