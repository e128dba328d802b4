// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_LINK_LOAD_H_
#define MECHANISM_CODESIGN_ELEMENTS_LINK_LOAD_H_

#include "elements/state_view.h"
#include "elements/workspace.h"

namespace codesign {

// The study's constant wrenches on links, theory (13g). Forces in the root's axes enter as those of multipliers do, (7), with b = -F; they
// must be added before the bodies are assembled.

template <class T>
void add_link_load(const StateView<T>& view, Workspace<T>* workspace, std::size_t k) {
  const LinkLoad& load = view.system.link_loads()[k];
  if (load.turns) return;
  BodyLoad<T>& on_body = workspace->loads[static_cast<std::size_t>(load.body)];
  on_body.force -= view.design.wrenches[k].force;
  on_body.W -= view.design.wrenches[k].force * view.design.wrenches[k].point.transpose();
}

template <class T>
void link_load_residual(const StateView<T>& view, std::size_t k, VectorX<T>* G) {
  const LinkLoad& load = view.system.link_loads()[k];
  const ConstantWrench<T>& wrench = view.design.wrenches[k];
  const BodyKinematics<T>& on = view.body(load.body);
  const int c = kBodySize * load.body;
  if (load.turns) {
    G->template segment<3>(c) -= on.A * wrench.force;
    G->template segment<4>(c + 3) -= T(2.0) * body_rate_transposed(on.p, wrench.torque);
  } else {
    G->template segment<4>(c + 3) -= T(2.0) * (ground_rate_matrix(on.p).transpose() * wrench.torque);
  }
}

template <class T, class Sink>
void assemble_link_load(const StateView<T>& view, std::size_t k, Sink* sink) {
  const LinkLoad& load = view.system.link_loads()[k];
  const ConstantWrench<T>& wrench = view.design.wrenches[k];
  const int c = kBodySize * load.body;
  const Vector3<T> twice = T(-2.0) * wrench.torque;
  const Matrix4<T> turning = load.turns ? body_rate_hessian<T>(twice) : ground_rate_hessian<T>(twice);
  for (int row = 0; row < 4; ++row)
    for (int e = 0; e < 4; ++e) sink->position(c + 3 + row, c + 3 + e, turning(row, e));
  if (!load.turns) return;
  const Matrix34<T> B = rotated_vector_jacobian(view.body(load.body).p, wrench.force);
  for (int row = 0; row < 3; ++row)
    for (int e = 0; e < 4; ++e) sink->position(c + row, c + 3 + e, T(-B(row, e)));
}

template <class T>
T link_load_power(const StateView<T>& view, std::size_t k, OptionalGradient<T> gradient) {
  const LinkLoad& load = view.system.link_loads()[k];
  const ConstantWrench<T>& wrench = view.design.wrenches[k];
  const BodyKinematics<T>& on = view.body(load.body);
  const int c = kBodySize * load.body;
  const Vector3<T> force = load.turns ? Vector3<T>(on.A * wrench.force) : wrench.force;
  // What multiplies p', as a function of p that is linear: the same function of p' is the derivative of the power by p, but for signs.
  const auto on_p = [&](const Vector4<T>& p, double turn) -> Vector4<T> {
    if (load.turns) return T(turn) * body_rate_transposed(p, wrench.torque);
    return rotated_vector_jacobian(p, wrench.point).transpose() * wrench.force +
           T(turn) * (ground_rate_matrix(p).transpose() * wrench.torque);
  };
  const Vector4<T> by_pd = on_p(on.p, 2.0);
  T power = dot<T>(force, on.rd);
  for (int e = 0; e < 4; ++e) power += by_pd[e] * on.pd[e];
  if (!gradient) return power;
  Vector4<T> by_p = on_p(on.pd, -2.0);
  if (load.turns) by_p += rotated_vector_jacobian(on.p, wrench.force).transpose() * on.rd;
  for (int l = 0; l < 3; ++l) gradient->velocity.push_back({c + l, force[l]});
  for (int e = 0; e < 4; ++e) gradient->velocity.push_back({c + 3 + e, by_pd[e]});
  for (int e = 0; e < 4; ++e) gradient->position.push_back({c + 3 + e, by_p[e]});
  return power;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_LINK_LOAD_H_
