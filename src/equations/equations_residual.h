// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_RESIDUAL_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_RESIDUAL_H_

#include "equations/equations.h"
#include "equations/rigid_body.h"

namespace codesign {

template <class T>
Equations<T>::Equations(const System& system) : system_(system), layout_(system.layout()), compiled_(system) {
  for (int k = 0; k < 3; ++k) gravity_[k] = T(system.study().gravity[static_cast<std::size_t>(k)]);
  kinematics_.resize(static_cast<std::size_t>(layout_.bodies) + 1);
  kinematics_.back().at_rest = true;
  loads_.resize(static_cast<std::size_t>(layout_.bodies));
  constraint_state_.resize(layout_);
  if (system.sharing().drops()) {
    displaced_ = kinematics_;
    shared_loads_ = loads_;
  }
  std::size_t nodes = 0;
  for (const Controller& controller : system.controllers()) {
    inverse_dynamics_.emplace_back(controller.tree);
    nodes = std::max(nodes, controller.tree.nodes.size());
  }
  for (std::vector<T>* of_nodes : {&accelerations_, &by_acceleration_, &rates_, &by_rate_}) of_nodes->resize(nodes, T(0.0));
  for (const Pair& pair : system.topology().pairs) {
    std::array<int, kLocalSize>& columns = columns_.emplace_back();
    for (int local = 0; local < kLocalSize; ++local) {
      const int body = local < kBodySize ? pair.body_i : pair.body_j;
      columns[static_cast<std::size_t>(local)] = body < 0 ? -1 : kBodySize * body + local % kBodySize;
    }
  }
}

template <class T>
void Equations<T>::set_design(const std::vector<T>& parameters) {
  ++version_;
  parameters_ = parameters;
  compiled_.set_design(parameters);
  constants_ = evaluate_constants(system_.robot(), system_.topology(), parameters);
  set_constant_loads();
  rows_.clear();
  for (std::size_t k = 0; k < constants_.pairs.size(); ++k)
    rows_.push_back(pair_rows(system_.topology().pairs[k].kind, constants_.pairs[k]));
  if (turn_references_.empty()) {
    for (const PairConstants<T>& pair : constants_.pairs) {
      turn_references_.emplace_back(pair.coordinates.size(), 0.0);
      coordinates_.emplace_back(pair.coordinates.size());
    }
    if (system_.sharing().drops()) {
      turn_references_.emplace_back(static_cast<std::size_t>(system_.sharing_layout().misses), 0.0);
      for (int row : system_.sharing().dropped)
        turn_references_.back()[static_cast<std::size_t>(system_.sharing_layout().miss_slot[static_cast<std::size_t>(row)])] = 1.0;
    }
  }
  const auto evaluate = [&parameters](const auto& terms, std::vector<T>* weights, std::vector<Reference<T>>* references) {
    weights->clear();
    references->clear();
    for (const ObjectiveTerm& term : terms) {
      weights->push_back(term.weight.at(parameters));
      references->emplace_back(term.reference, parameters);
    }
  };
  const Study& study = system_.study();
  controllers_.clear();
  for (const ControllerDescription& description : study.controllers) controllers_.push_back(controller_constants(description, parameters));
  evaluate(study.integral, &integral_weights_, &integral_references_);
  evaluate(study.terminal, &terminal_weights_, &terminal_references_);
}

template <class T>
void Equations<T>::load(const State<T>& state) {
  ++version_;
  state_ = &state;
  for (int b = 0; b < layout_.bodies; ++b) {
    BodyKinematics<T>& k = kinematics_[static_cast<std::size_t>(b)];
    const int c = kBodySize * b;
    k.r = state.q.template segment<3>(c);
    k.p = state.q.template segment<4>(c + 3);
    k.rd = state.v.template segment<3>(c);
    k.pd = state.v.template segment<4>(c + 3);
    k.rdd = state.z.template segment<3>(c);
    k.pdd = state.z.template segment<4>(c + 3);
    k.update_rotation();
  }
}

template <class T>
void Equations<T>::residual(const State<T>& state, VectorX<T>* G, T* g) {
  if (!compiled_.residual(state, turn_references_, G, g)) residual_by_formulas(state, G, g);
}

template <class T>
void Equations<T>::residual_by_formulas(const State<T>& state, VectorX<T>* G, T* g) {
  load(state);
  G->setZero(layout_.columns());
  for (BodyLoad<T>& load : loads_) {
    load.force.setZero();
    load.W.setZero();
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) pair_residual(k, G);
  for (std::size_t k = 0; k < constants_.springs.size(); ++k) add_spring_load(k, spring(k));
  for (std::size_t k = 0; k < wrenches_.size(); ++k) add_link_load(k);
  for (int b = 0; b < layout_.bodies; ++b) body_residual(static_cast<std::size_t>(b), G);
  for (std::size_t k = 0; k < wrenches_.size(); ++k) link_load_residual(k, G);
  for (const Rotor& rotor : system_.rotors()) rotor_residual(rotor, G);
  for (std::size_t k = 0; k < constants_.couplings.size(); ++k) coupling_residual(k, G);
  for (const JointLoad& load : system_.loads()) load_residual(load, G);
  for (int pair : system_.contacts()) contact_residual(pair, G);
  for (const BristleContact& contact : system_.bristles()) bristle_residual(contact, G);
  for (std::size_t c = 0; c < system_.controllers().size(); ++c) {
    const int s = system_.controllers()[c].state;
    if (s >= 0) (*G)[layout_.state_column(s)] = state.z[layout_.state_column(s)] - controller_error(static_cast<int>(c), nullptr);
  }
  if (system_.sharing().drops()) sharing_residual(G);
  *g = objective_terms(system_.integral(), integral_weights_, integral_references_, nullptr);
}

template <class T>
void Equations<T>::pair_residual(std::size_t k, VectorX<T>* G) {
  const Pair& pair = system_.topology().pairs[k];
  const PairRows<T>& rows = rows_[k];
  const BodyKinematics<T>&i = body(pair.body_i), &j = body(pair.body_j);
  BodyLoad<T>*load_i = load_on(pair.body_i), *load_j = load_on(pair.body_j);
  int row = layout_.lambda_column(layout_.pair_row[k]);
  if (rows.coincident) {
    const Vector3<T>&s_i = rows.point(Side::kI), &s_j = rows.point(Side::kJ);
    G->template segment<3>(row).setZero();
    if (load_j) G->template segment<3>(row) = j.rdd + j.Add * s_j;
    if (load_i) G->template segment<3>(row) -= i.rdd + i.Add * s_i;
    const Vector3<T> lambda = state_->z.template segment<3>(row);
    add_vector_load(PairVector<T>::displacement(s_i, s_j), lambda, load_i, load_j);
    row += 3;
  }
  PairMotion<T> shared;
  shared.update(rows, i, j, false);
  for (const ProductRow<T>& product : rows.products) {
    const VectorMotion<T>&x = shared.of(product.X), &y = shared.of(product.Y);
    const double scale = product.scale;
    (*G)[row] = scale * product_motion(x, y).phidd;
    add_product_load(product.X, product.Y, x, y, T(scale * state_->z[row]), load_i, load_j);
    ++row;
  }
  if (system_.compliance() == 0.0) return;
  const int first = layout_.lambda_column(layout_.pair_row[k]);
  G->segment(first, rows.size()) -= T(system_.compliance()) * state_->z.segment(first, rows.size());
}

template <class T>
void Equations<T>::body_residual(std::size_t b, VectorX<T>* G) {
  const BodyKinematics<T>& k = kinematics_[b];
  const int c = kBodySize * static_cast<int>(b), norm = layout_.lambda_column(layout_.norm_row(static_cast<int>(b)));
  Vector3<T> on_r;
  Vector4<T> on_p;
  inertia_force(constants_.bodies[b], k, &on_r, &on_p);
  G->template segment<3>(c) += on_r - constants_.bodies[b].mass * gravity_ + loads_[b].force;
  G->template segment<4>(c + 3) += on_p + rotation_hessian_product(loads_[b].W, k.p) + state_->z[norm] * k.p;
  T sum(0.0);
  for (int e = 0; e < 4; ++e) sum += k.p[e] * k.pdd[e] + k.pd[e] * k.pd[e];
  (*G)[norm] = sum;
}

template <class T>
void Equations<T>::constraint_errors(const VectorX<T>& q, const VectorX<T>& v, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  if (!compiled_.constraint_errors(q, v, turn_references_, Phi, Phi_rate)) constraint_errors_by_formulas(q, v, Phi, Phi_rate);
}

template <class T>
void Equations<T>::constraint_errors_by_formulas(const VectorX<T>& q, const VectorX<T>& v, VectorX<T>* Phi, VectorX<T>* Phi_rate) {
  constraint_state_.q = q;
  constraint_state_.v = v;
  load(constraint_state_);
  Phi->setZero(layout_.m);
  Phi_rate->setZero(layout_.m);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Pair& pair = system_.topology().pairs[k];
    const int row = layout_.pair_row[k];
    pair_errors(static_cast<int>(k), body(pair.body_i), body(pair.body_j), Phi->data() + row, Phi_rate->data() + row);
  }
  for (std::size_t k = 0; k < constants_.couplings.size(); ++k) coupling_error(k, Phi, Phi_rate);
  for (int b = 0; b < layout_.bodies; ++b) {
    T square(0.0), rate(0.0);
    for (int e = 0; e < 4; ++e) {
      square += body(b).p[e] * body(b).p[e];
      rate += body(b).p[e] * body(b).pd[e];
    }
    (*Phi)[layout_.norm_row(b)] = 0.5 * (square - 1.0);
    (*Phi_rate)[layout_.norm_row(b)] = rate;
  }
  state_ = nullptr;
}

template <class T>
void Equations<T>::pair_errors(int pair, const BodyKinematics<T>& i, const BodyKinematics<T>& j, T* errors, T* rates) const {
  const PairRows<T>& rows = rows_[static_cast<std::size_t>(pair)];
  if (rows.coincident) {
    const VectorMotion<T> d = displacement_motion(i, rows.point(Side::kI), j, rows.point(Side::kJ));
    for (int k = 0; k < 3; ++k) {
      *errors++ = d.x[k];
      *rates++ = d.xd[k];
    }
  }
  for (const ProductRow<T>& product : rows.products) {
    const ProductMotion<T> phi = product_motion(motion_of(product.X, i, j), motion_of(product.Y, i, j));
    *errors++ = product.scale * (phi.phi - product.offset);
    *rates++ = product.scale * phi.phid;
  }
}

template <class T>
void Equations<T>::reaction(int pair, Vector3<T>* F, Vector3<T>* torque) const {
  const PairKind kind = system_.topology().pairs[static_cast<std::size_t>(pair)].kind;
  const int row = layout_.lambda_column(layout_.pair_row[static_cast<std::size_t>(pair)]);
  const auto lambda = [this, row](int k) { return state_->z[row + k]; };
  F->setZero();
  torque->setZero();
  const auto& rows = rows_[static_cast<std::size_t>(pair)];
  int next = 0;
  if (rows.coincident) {
    const PairConstants<T>& c = constants_.pairs[static_cast<std::size_t>(pair)];
    const Vector3<T> on_child = state_->z.template segment<3>(row);
    *F = c.C_i.transpose() * (body(system_.topology().pairs[static_cast<std::size_t>(pair)].body_i).A.transpose() * on_child);
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

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_RESIDUAL_H_
