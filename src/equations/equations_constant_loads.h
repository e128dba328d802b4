// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONSTANT_LOADS_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONSTANT_LOADS_H_

#include "equations/equations.h"

namespace codesign {

// The study's constant loads, theory (13g). Forces in the root's axes enter as those of multipliers do, (7), with b = -F; they must be
// added before the bodies are assembled.

template <class T>
void Equations<T>::set_constant_loads() {
  const Study& study = system_.study();
  efforts_.clear();
  for (const LoadDescription& load : study.loads) efforts_.push_back(load.effort.at(parameters_));
  wrenches_.clear();
  for (const LinkLoad& on_link : system_.link_loads()) {
    const LoadDescription& load = study.loads[static_cast<std::size_t>(on_link.load)];
    const LinkConstants<T>& link = constants_.links[static_cast<std::size_t>(on_link.link)];
    const auto vector = [this](const QuantityVector& q) {
      return Vector3<T>(q[0].at(parameters_), q[1].at(parameters_), q[2].at(parameters_));
    };
    ConstantWrench<T> wrench{vector(load.force), vector(load.torque), link.R * vector(load.point) + link.s};
    if (on_link.turns) {
      wrench.force = link.R * wrench.force;
      wrench.torque = link.R * wrench.torque + cross<T>(wrench.point, wrench.force);
    }
    wrenches_.push_back(wrench);
  }
}

template <class T>
T Equations<T>::constant_effort(const JointLoad& load) const {
  T sum(0.0);
  for (int k : load.constant) sum += efforts_[static_cast<std::size_t>(k)];
  return sum;
}

template <class T>
void Equations<T>::add_link_load(std::size_t k) {
  const LinkLoad& load = system_.link_loads()[k];
  if (load.turns) return;
  BodyLoad<T>& on_body = loads_[static_cast<std::size_t>(load.body)];
  on_body.force -= wrenches_[k].force;
  on_body.W -= wrenches_[k].force * wrenches_[k].point.transpose();
}

template <class T>
void Equations<T>::link_load_residual(std::size_t k, VectorX<T>* G) {
  const LinkLoad& load = system_.link_loads()[k];
  const ConstantWrench<T>& wrench = wrenches_[k];
  const BodyKinematics<T>& on = body(load.body);
  const int c = kBodySize * load.body;
  if (load.turns) {
    G->template segment<3>(c) -= on.A * wrench.force;
    G->template segment<4>(c + 3) -= T(2.0) * body_rate_transposed(on.p, wrench.torque);
  } else {
    G->template segment<4>(c + 3) -= T(2.0) * (ground_rate_matrix(on.p).transpose() * wrench.torque);
  }
}

template <class T>
template <class Sink>
void Equations<T>::assemble_link_load(std::size_t k, Sink* sink) {
  const LinkLoad& load = system_.link_loads()[k];
  const ConstantWrench<T>& wrench = wrenches_[k];
  const int c = kBodySize * load.body;
  const Vector3<T> twice = T(-2.0) * wrench.torque;
  const Matrix4<T> turning = load.turns ? body_rate_hessian<T>(twice) : ground_rate_hessian<T>(twice);
  for (int row = 0; row < 4; ++row)
    for (int e = 0; e < 4; ++e) sink->position(c + 3 + row, c + 3 + e, turning(row, e));
  if (!load.turns) return;
  const Matrix34<T> B = rotated_vector_jacobian(body(load.body).p, wrench.force);
  for (int row = 0; row < 3; ++row)
    for (int e = 0; e < 4; ++e) sink->position(c + row, c + 3 + e, T(-B(row, e)));
}

template <class T>
T Equations<T>::link_load_power(std::size_t k, SparseGradient<T>* gradient) const {
  const LinkLoad& load = system_.link_loads()[k];
  const ConstantWrench<T>& wrench = wrenches_[k];
  const BodyKinematics<T>& on = body(load.body);
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

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_CONSTANT_LOADS_H_
