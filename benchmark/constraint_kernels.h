// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "benchmark/kernel_products.h"
#include "equations/compiled_system.h"
#include "joints/body_kinematics.h"
#include "joints/pair_rows.h"
#include "mechanism/constants.h"

namespace codesign {

/// The operations on constraints that the paper times in its Table 1, each as a function of its
/// own, written by hand from the formulas of doc/theory.md (1)-(7). Only the benchmark uses them:
/// the equations of motion evaluate all derivatives of a joint together.
///
/// A row between a body and the ground is c . r + p^T K p / 2 + constant with a constant matrix K,
/// theory (3); its derivatives cost one product with K. T is double, or a number with derivatives
/// to differentiate the same code automatically.
template <class T>
class ConstraintKernels {
 public:
  ConstraintKernels(const CompiledSystem& system, const Constants<double>& constants);

  int rows() const { return layout_.m; }
  int columns() const { return layout_.n; }

  /// Phi(q), m values.
  void values(const T* q, T* Phi);
  /// The entries of Phi_q that can differ from zero, in the fixed order of entries(). Values for
  /// the same row and column add up.
  void jacobian(const T* q, T* Phi_q);
  /// Phi_q v, m values.
  void jacobian_times(const T* q, const T* v, T* product);
  /// Phi_q^T lambda, n values.
  void transposed_times(const T* q, const T* lambda, T* product);
  /// (Phi_q v)_q v, m values.
  void curvature(const T* q, const T* v, T* product);

  struct Entry {
    int row, column;
  };
  /// Row and column of each value of jacobian().
  std::vector<Entry> entries() const;

 private:
  /// One body's part of three rows of coincident points, theory (5): sign (r + A s). Without an arm
  /// s is zero.
  struct Coincidence {
    int row;
    std::size_t body;
    double sign;
    bool first, has_arm;
    Vector3<T> arm;  ///< sign s
  };
  /// A product row between one body and the ground, in the form above.
  struct Grounded {
    int row;
    std::size_t body;
    bool moves_r;
    Eigen::Vector3d c;
    Eigen::Matrix3d W;  ///< K = K(W)
    Eigen::Matrix4d K;
    double constant;
  };
  /// Any other product row, theory (6).
  struct General {
    int row;
    std::size_t i, j;
    ProductRow<T> product;
  };

  void add_joint(const Pair& pair, const PairConstants<double>& constants, int row);
  /// Adds a product row as Grounded if one of its bodies is the ground and its vector there is a
  /// constant direction; returns whether it did.
  bool add_grounded(const ProductRow<double>& product, std::size_t i, std::size_t j, int row);
  static ProductRow<T> converted(const ProductRow<double>& product);

  void load_positions(const T* q);
  void load_velocities(const T* v);
  template <class Point, class Turn>
  void add_points(const Point& point, const Turn& turn, T* out);
  bool is_ground(std::size_t body) const { return body + 1 == bodies_.size(); }
  T* add_gradient(const PairVector<T>& X, const Vector3<T>& y, const General& row, T* out) const;
  static Vector4<T> product(const Eigen::Matrix4d& K, const Vector4<T>& p);

  const Layout& layout_;
  std::vector<Coincidence> coincidences_;
  std::vector<Grounded> grounded_;
  std::vector<General> general_;
  std::vector<BodyKinematics<T>> bodies_;  ///< the ground last
  std::vector<BodyLoad<T>> loads_;
  std::vector<std::size_t> turned_;  ///< bodies whose rotation matrix the general rows need
};

template <class T>
ConstraintKernels<T>::ConstraintKernels(const CompiledSystem& system,
                                        const Constants<double>& constants)
    : layout_(system.layout()) {
  bodies_.resize(static_cast<std::size_t>(layout_.bodies) + 1);
  loads_.resize(bodies_.size());
  for (std::size_t k = 0; k < constants.pairs.size(); ++k)
    add_joint(system.topology().pairs[k], constants.pairs[k], layout_.pair_row[k]);
}

template <class T>
void ConstraintKernels<T>::add_joint(const Pair& pair, const PairConstants<double>& constants,
                                     int row) {
  const std::size_t ground = bodies_.size() - 1;
  const std::size_t i = pair.body_i < 0 ? ground : static_cast<std::size_t>(pair.body_i),
                    j = pair.body_j < 0 ? ground : static_cast<std::size_t>(pair.body_j);
  const PairRows<double> rows = pair_rows(pair.kind, constants);
  if (rows.coincident) {
    coincidences_.push_back({row, i, -1.0, true, !rows.point(Side::kI).isZero(0.0),
                             -rows.point(Side::kI).template cast<T>()});
    coincidences_.push_back({row, j, 1.0, false, !rows.point(Side::kJ).isZero(0.0),
                             rows.point(Side::kJ).template cast<T>()});
    row += 3;
  }
  for (const ProductRow<double>& product : rows.products) {
    if (!add_grounded(product, i, j, row)) {
      general_.push_back({row, i, j, converted(product)});
      for (const std::size_t body : {i, j})
        if (!is_ground(body) && std::find(turned_.begin(), turned_.end(), body) == turned_.end())
          turned_.push_back(body);
    }
    ++row;
  }
}

template <class T>
bool ConstraintKernels<T>::add_grounded(const ProductRow<double>& product, std::size_t i,
                                        std::size_t j, int row) {
  if (!is_ground(i) && !is_ground(j)) return false;
  const Side fixed = is_ground(i) ? Side::kI : Side::kJ;
  const PairVector<double>*c = &product.X, *moving = &product.Y;
  if (c->terms != 1 || c->term[0].side != fixed) std::swap(c, moving);
  if (c->terms != 1 || c->term[0].side != fixed) return false;
  const Eigen::Vector3d direction = product.scale * c->term[0].s;
  Grounded grounded{row,
                    fixed == Side::kI ? j : i,
                    false,
                    Eigen::Vector3d::Zero(),
                    Eigen::Matrix3d::Zero(),
                    Eigen::Matrix4d::Zero(),
                    -product.scale * product.offset};
  for (int k = 0; k < moving->terms; ++k) {
    const VectorTerm<double>& term = moving->term[k];
    if (term.side == fixed) {
      grounded.constant += term.sign * direction.dot(term.s);
      continue;
    }
    grounded.W += term.sign * direction * term.s.transpose();
    if (term.point) grounded.c += term.sign * direction;
    grounded.moves_r = grounded.moves_r || term.point;
  }
  grounded.K = rotation_hessian(grounded.W);
  grounded_.push_back(grounded);
  return true;
}

template <class T>
ProductRow<T> ConstraintKernels<T>::converted(const ProductRow<double>& product) {
  const auto vector = [](const PairVector<double>& x) {
    PairVector<T> y;
    y.terms = x.terms;
    for (int k = 0; k < x.terms; ++k)
      y.term[k] = {x.term[k].side, x.term[k].point, x.term[k].sign, x.term[k].s.template cast<T>()};
    return y;
  };
  return {vector(product.X), vector(product.Y), T(product.offset), product.scale};
}

template <class T>
void ConstraintKernels<T>::load_positions(const T* q) {
  for (int b = 0; b < layout_.bodies; ++b, q += kBodySize) {
    BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    body.r = Vector3<T>(q[0], q[1], q[2]);
    body.p = Vector4<T>(q[3], q[4], q[5], q[6]);
  }
  for (const std::size_t b : turned_) bodies_[b].A = rotation(bodies_[b].p);
}

/// Evaluates the rows of coincident points, or one of their time derivatives. @param point, turn
/// give r and A of a body, or their derivatives.
template <class T>
template <class Point, class Turn>
void ConstraintKernels<T>::add_points(const Point& point, const Turn& turn, T* out) {
  for (const Coincidence& side : coincidences_) {
    const BodyKinematics<T>& body = bodies_[side.body];
    Vector3<T> x = T(side.sign) * point(body);
    if (side.has_arm) x += turn(body) * side.arm;
    for (int k = 0; k < 3; ++k) out[side.row + k] = side.first ? x[k] : T(out[side.row + k] + x[k]);
  }
}

template <class T>
void ConstraintKernels<T>::load_velocities(const T* v) {
  for (int b = 0; b < layout_.bodies; ++b, v += kBodySize) {
    BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    body.rd = Vector3<T>(v[0], v[1], v[2]);
    body.pd = Vector4<T>(v[3], v[4], v[5], v[6]);
  }
}

template <class T>
Vector4<T> ConstraintKernels<T>::product(const Eigen::Matrix4d& K, const Vector4<T>& p) {
  Vector4<T> y;
  for (int r = 0; r < 4; ++r)
    y[r] = p[0] * K(r, 0) + p[1] * K(r, 1) + p[2] * K(r, 2) + p[3] * K(r, 3);
  return y;
}

template <class T>
void ConstraintKernels<T>::values(const T* q, T* Phi) {
  load_positions(q);
  add_points([](const BodyKinematics<T>& body) { return body.r; },
             [](const BodyKinematics<T>& body) { return rotation(body.p); }, Phi);
  for (const Grounded& row : grounded_) {
    const BodyKinematics<T>& body = bodies_[row.body];
    Phi[row.row] = T(0.5) * internal::dot4(body.p, product(row.K, body.p)) + T(row.constant);
    if (row.moves_r)
      Phi[row.row] += body.r[0] * row.c[0] + body.r[1] * row.c[1] + body.r[2] * row.c[2];
  }
  for (const General& row : general_) {
    const BodyKinematics<T>&i = bodies_[row.i], &j = bodies_[row.j];
    Phi[row.row] = T(row.product.scale) *
                   (dot(motion_of(row.product.X, i, j).x, motion_of(row.product.Y, i, j).x) -
                    row.product.offset);
  }
  for (int b = 0; b < layout_.bodies; ++b) {
    const Vector4<T>& p = bodies_[static_cast<std::size_t>(b)].p;
    Phi[layout_.norm_row(b)] = T(0.5) * (internal::dot4(p, p) - T(1.0));
  }
}

/// Writes the part of (X . Y)_q from the terms of X. @param y the value of Y. @param out where it
/// starts; returns where it ends.
template <class T>
T* ConstraintKernels<T>::add_gradient(const PairVector<T>& X, const Vector3<T>& y,
                                      const General& row, T* out) const {
  for (int k = 0; k < X.terms; ++k) {
    const VectorTerm<T>& term = X.term[k];
    const std::size_t body = term.side == Side::kI ? row.i : row.j;
    if (is_ground(body)) continue;
    const Vector3<T> signed_y = T(term.sign) * y;
    if (term.point)
      for (int c = 0; c < 3; ++c) *out++ = signed_y[c];
    const Vector4<T> on_p = internal::gradient_on_p(bodies_[body].p, term.s, signed_y);
    for (int c = 0; c < 4; ++c) *out++ = on_p[c];
  }
  return out;
}

template <class T>
void ConstraintKernels<T>::jacobian(const T* q, T* Phi_q) {
  load_positions(q);
  T* out = Phi_q;
  for (const Coincidence& side : coincidences_) {
    if (is_ground(side.body)) continue;
    for (int r = 0; r < 3; ++r) *out++ = T(side.sign);
    if (!side.has_arm) continue;
    const Matrix34<T> B = rotated_vector_jacobian(bodies_[side.body].p, side.arm);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) *out++ = B(r, c);
  }
  for (const Grounded& row : grounded_) {
    if (row.moves_r)
      for (int c = 0; c < 3; ++c) *out++ = T(row.c[c]);
    const Vector4<T> on_p = product(row.K, bodies_[row.body].p);
    for (int c = 0; c < 4; ++c) *out++ = on_p[c];
  }
  for (const General& row : general_) {
    const BodyKinematics<T>&i = bodies_[row.i], &j = bodies_[row.j];
    const T scale(row.product.scale);
    out = add_gradient(row.product.X, scale * motion_of(row.product.Y, i, j).x, row, out);
    out = add_gradient(row.product.Y, scale * motion_of(row.product.X, i, j).x, row, out);
  }
  for (int b = 0; b < layout_.bodies; ++b)
    for (int c = 0; c < 4; ++c) *out++ = bodies_[static_cast<std::size_t>(b)].p[c];
}

template <class T>
std::vector<typename ConstraintKernels<T>::Entry> ConstraintKernels<T>::entries() const {
  std::vector<Entry> list;
  const auto add = [&list](int row, std::size_t body, int first) {
    for (int c = first; c < kBodySize; ++c)
      list.push_back({row, kBodySize * static_cast<int>(body) + c});
  };
  for (const Coincidence& side : coincidences_) {
    if (is_ground(side.body)) continue;
    for (int r = 0; r < 3; ++r)
      list.push_back({side.row + r, kBodySize * static_cast<int>(side.body) + r});
    for (int r = 0; r < 3 && side.has_arm; ++r) add(side.row + r, side.body, 3);
  }
  for (const Grounded& row : grounded_) add(row.row, row.body, row.moves_r ? 0 : 3);
  for (const General& row : general_)
    for (const PairVector<T>* X : {&row.product.X, &row.product.Y})
      for (int k = 0; k < X->terms; ++k) {
        const std::size_t body = X->term[k].side == Side::kI ? row.i : row.j;
        if (!is_ground(body)) add(row.row, body, X->term[k].point ? 0 : 3);
      }
  for (int b = 0; b < layout_.bodies; ++b) add(layout_.norm_row(b), static_cast<std::size_t>(b), 3);
  return list;
}

template <class T>
void ConstraintKernels<T>::jacobian_times(const T* q, const T* v, T* out) {
  load_positions(q);
  load_velocities(v);
  for (const std::size_t b : turned_)
    bodies_[b].Ad = rotation_derivative(bodies_[b].p, bodies_[b].pd);
  for (int b = 0; b < layout_.bodies; ++b) {
    const BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    out[layout_.norm_row(b)] = internal::dot4(body.p, body.pd);
  }
  add_points([](const BodyKinematics<T>& body) { return body.rd; },
             [](const BodyKinematics<T>& body) { return rotation_derivative(body.p, body.pd); },
             out);
  for (const Grounded& row : grounded_) {
    const BodyKinematics<T>& body = bodies_[row.body];
    out[row.row] = internal::dot4(body.pd, product(row.K, body.p));
    if (row.moves_r)
      out[row.row] += body.rd[0] * row.c[0] + body.rd[1] * row.c[1] + body.rd[2] * row.c[2];
  }
  for (const General& row : general_) {
    const BodyKinematics<T>&i = bodies_[row.i], &j = bodies_[row.j];
    const VectorMotion<T> x = motion_of(row.product.X, i, j), y = motion_of(row.product.Y, i, j);
    out[row.row] = T(row.product.scale) * (dot(x.xd, y.x) + dot(x.x, y.xd));
  }
}

template <class T>
void ConstraintKernels<T>::transposed_times(const T* q, const T* lambda, T* out) {
  load_positions(q);
  for (BodyLoad<T>& load : loads_) {
    load.force.setZero();
    load.W.setZero();
  }
  for (const Coincidence& side : coincidences_) {
    const Vector3<T> force(lambda[side.row], lambda[side.row + 1], lambda[side.row + 2]);
    loads_[side.body].force += T(side.sign) * force;
    if (side.has_arm) loads_[side.body].W += force * side.arm.transpose();
  }
  for (const Grounded& row : grounded_) {
    BodyLoad<T>& load = loads_[row.body];
    for (int c = 0; c < 3; ++c) load.force[c] += lambda[row.row] * row.c[c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) load.W(r, c) += lambda[row.row] * row.W(r, c);
  }
  for (const General& row : general_) {
    const BodyKinematics<T>&i = bodies_[row.i], &j = bodies_[row.j];
    const T weight = T(row.product.scale) * lambda[row.row];
    add_product_load(row.product.X, row.product.Y, motion_of(row.product.X, i, j),
                     motion_of(row.product.Y, i, j), weight, &loads_[row.i], &loads_[row.j]);
  }
  for (int b = 0; b < layout_.bodies; ++b, out += kBodySize) {
    const auto k = static_cast<std::size_t>(b);
    const Vector4<T> on_p =
        rotation_hessian(loads_[k].W) * bodies_[k].p + lambda[layout_.norm_row(b)] * bodies_[k].p;
    for (int c = 0; c < 3; ++c) out[c] = loads_[k].force[c];
    for (int c = 0; c < 4; ++c) out[3 + c] = on_p[c];
  }
}

template <class T>
void ConstraintKernels<T>::curvature(const T* q, const T* v, T* out) {
  load_velocities(v);
  if (!turned_.empty()) load_positions(q);
  for (const std::size_t b : turned_) {
    bodies_[b].Ad = rotation_derivative(bodies_[b].p, bodies_[b].pd);
    bodies_[b].Add = T(2.0) * rotation(bodies_[b].pd);
  }
  for (int b = 0; b < layout_.bodies; ++b) {
    const Vector4<T>& pd = bodies_[static_cast<std::size_t>(b)].pd;
    out[layout_.norm_row(b)] = internal::dot4(pd, pd);
  }
  add_points([](const BodyKinematics<T>&) { return Vector3<T>(Vector3<T>::Zero()); },
             [](const BodyKinematics<T>& body) { return Matrix3<T>(T(2.0) * rotation(body.pd)); },
             out);
  for (const Grounded& row : grounded_)
    out[row.row] = internal::dot4(bodies_[row.body].pd, product(row.K, bodies_[row.body].pd));
  for (const General& row : general_) {
    const BodyKinematics<T>&i = bodies_[row.i], &j = bodies_[row.j];
    out[row.row] =
        T(row.product.scale) *
        product_motion(motion_of(row.product.X, i, j), motion_of(row.product.Y, i, j)).phidd;
  }
}

}  // namespace codesign
