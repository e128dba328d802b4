// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_BENCHMARK_CONSTRAINT_KERNELS_H_
#define MECHANISM_CODESIGN_BENCHMARK_CONSTRAINT_KERNELS_H_

#include <cstddef>
#include <vector>

#include "mechanism_codesign/dynamics/system.h"
#include "mechanism_codesign/joints/body_kinematics.h"
#include "mechanism_codesign/joints/pair_rows.h"

namespace codesign {

/// The operations on constraints that the paper times in its Table 1, one by one, written by hand from the forms of doc/theory.md (1)-(7).
/// The equations of motion never need them one by one: they take all derivatives of a joint in one go.
///
/// T is double, or a number with derivatives to differentiate the same code automatically.
template <class T>
class ConstraintKernels {
 public:
  ConstraintKernels(const System& system, const Constants<T>& constants) : layout_(system.layout()) {
    bodies_.resize(static_cast<std::size_t>(layout_.bodies) + 1);
    loads_.resize(bodies_.size());
    for (std::size_t k = 0; k < constants.pairs.size(); ++k) {
      const Pair& pair = system.topology().pairs[k];
      const std::size_t ground = bodies_.size() - 1;
      joints_.push_back({pair_rows(pair.kind, constants.pairs[k]), pair.body_i < 0 ? ground : static_cast<std::size_t>(pair.body_i),
                         pair.body_j < 0 ? ground : static_cast<std::size_t>(pair.body_j), layout_.pair_row[k]});
    }
  }

  int rows() const { return layout_.m; }
  int columns() const { return layout_.n; }

  /// Phi(q), m values.
  void values(const T* q, T* Phi);
  /// The entries of Phi_q that can differ from zero, in a fixed order; entries() says which.
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
  /// Where the values of jacobian() stand.
  std::vector<Entry> entries() const;

 private:
  struct Joint {
    PairRows<T> rows;
    std::size_t i, j;  ///< bodies; the ground last
    int row;
  };

  void load_positions(const T* q);
  void load_velocities(const T* v);
  bool is_ground(std::size_t body) const { return body + 1 == bodies_.size(); }
  /// The part of (X . Y)_q that comes from X's own terms, y being Y's value: K(y s^T) p = B(p, s)^T y.
  T* add_gradient(const PairVector<T>& X, const Vector3<T>& y, const Joint& joint, T* out) const;
  Vector3<T> value_of_vector(const PairVector<T>& X, const Joint& joint) const;

  const Layout& layout_;
  std::vector<Joint> joints_;
  std::vector<BodyKinematics<T>> bodies_;
  std::vector<BodyLoad<T>> loads_;
};

template <class T>
void ConstraintKernels<T>::load_positions(const T* q) {
  for (int b = 0; b < layout_.bodies; ++b, q += kBodySize) {
    BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    body.r = Vector3<T>(q[0], q[1], q[2]);
    body.p = Vector4<T>(q[3], q[4], q[5], q[6]);
    body.A = rotation(body.p);
  }
}

template <class T>
void ConstraintKernels<T>::load_velocities(const T* v) {
  for (int b = 0; b < layout_.bodies; ++b, v += kBodySize) {
    BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    body.rd = Vector3<T>(v[0], v[1], v[2]);
    body.pd = Vector4<T>(v[3], v[4], v[5], v[6]);
    body.Ad = rotation_derivative(body.p, body.pd);
  }
}

template <class T>
Vector3<T> ConstraintKernels<T>::value_of_vector(const PairVector<T>& X, const Joint& joint) const {
  const BodyKinematics<T>&i = bodies_[joint.i], &j = bodies_[joint.j];
  const VectorTerm<T>& first = X.term[0];
  if (X.terms == 1) return (first.side == Side::kI ? i : j).A * first.s;
  return j.r + j.A * first.s - i.r - i.A * X.term[1].s;
}

template <class T>
void ConstraintKernels<T>::values(const T* q, T* Phi) {
  load_positions(q);
  for (const Joint& joint : joints_) {
    T* out = Phi + joint.row;
    if (joint.rows.coincident) {
      const BodyKinematics<T>&i = bodies_[joint.i], &j = bodies_[joint.j];
      const Vector3<T> d = j.r + j.A * joint.rows.s_j - i.r - i.A * joint.rows.s_i;
      for (int k = 0; k < 3; ++k) *out++ = d[k];
    }
    for (const ProductRow<T>& row : joint.rows.products)
      *out++ = T(row.scale) * (dot(value_of_vector(row.X, joint), value_of_vector(row.Y, joint)) - row.offset);
  }
  for (int b = 0; b < layout_.bodies; ++b) {
    const Vector4<T>& p = bodies_[static_cast<std::size_t>(b)].p;
    Phi[layout_.norm_row(b)] = T(0.5) * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3] - T(1.0));
  }
}

template <class T>
T* ConstraintKernels<T>::add_gradient(const PairVector<T>& X, const Vector3<T>& y, const Joint& joint, T* out) const {
  for (int k = 0; k < X.terms; ++k) {
    const VectorTerm<T>& term = X.term[k];
    const std::size_t body = term.side == Side::kI ? joint.i : joint.j;
    if (is_ground(body)) continue;
    const Vector3<T> signed_y = T(term.sign) * y;
    if (term.point)
      for (int c = 0; c < 3; ++c) *out++ = signed_y[c];
    const Vector4<T> on_p = rotated_vector_jacobian(bodies_[body].p, term.s).transpose() * signed_y;
    for (int c = 0; c < 4; ++c) *out++ = on_p[c];
  }
  return out;
}

template <class T>
void ConstraintKernels<T>::jacobian(const T* q, T* Phi_q) {
  load_positions(q);
  T* out = Phi_q;
  for (const Joint& joint : joints_) {
    if (joint.rows.coincident) {
      for (const bool of_j : {false, true}) {
        const std::size_t body = of_j ? joint.j : joint.i;
        if (is_ground(body)) continue;
        const Matrix34<T> B = rotated_vector_jacobian(bodies_[body].p, of_j ? joint.rows.s_j : joint.rows.s_i);
        const T sign(of_j ? 1.0 : -1.0);
        for (int r = 0; r < 3; ++r) {
          *out++ = sign;
          for (int c = 0; c < 4; ++c) *out++ = sign * B(r, c);
        }
      }
    }
    for (const ProductRow<T>& row : joint.rows.products) {
      const T scale(row.scale);
      out = add_gradient(row.X, scale * value_of_vector(row.Y, joint), joint, out);
      out = add_gradient(row.Y, scale * value_of_vector(row.X, joint), joint, out);
    }
  }
  for (int b = 0; b < layout_.bodies; ++b)
    for (int c = 0; c < 4; ++c) *out++ = bodies_[static_cast<std::size_t>(b)].p[c];
}

template <class T>
std::vector<typename ConstraintKernels<T>::Entry> ConstraintKernels<T>::entries() const {
  std::vector<Entry> list;
  const auto of_vector = [&](const PairVector<T>& X, const Joint& joint, int row) {
    for (int k = 0; k < X.terms; ++k) {
      const std::size_t body = X.term[k].side == Side::kI ? joint.i : joint.j;
      if (is_ground(body)) continue;
      for (int c = X.term[k].point ? 0 : 3; c < kBodySize; ++c) list.push_back({row, kBodySize * static_cast<int>(body) + c});
    }
  };
  for (const Joint& joint : joints_) {
    int row = joint.row;
    if (joint.rows.coincident) {
      for (const std::size_t body : {joint.i, joint.j})
        for (int r = 0; r < 3 && !is_ground(body); ++r) {
          list.push_back({row + r, kBodySize * static_cast<int>(body) + r});
          for (int c = 3; c < kBodySize; ++c) list.push_back({row + r, kBodySize * static_cast<int>(body) + c});
        }
      row += 3;
    }
    for (const ProductRow<T>& product : joint.rows.products) {
      of_vector(product.X, joint, row);
      of_vector(product.Y, joint, row);
      ++row;
    }
  }
  for (int b = 0; b < layout_.bodies; ++b)
    for (int c = 3; c < kBodySize; ++c) list.push_back({layout_.norm_row(b), kBodySize * b + c});
  return list;
}

template <class T>
void ConstraintKernels<T>::jacobian_times(const T* q, const T* v, T* product) {
  load_positions(q);
  load_velocities(v);
  const auto rate = [this](const PairVector<T>& X, const Joint& joint) -> Vector3<T> {
    const BodyKinematics<T>&i = bodies_[joint.i], &j = bodies_[joint.j];
    if (X.terms == 1) return (X.term[0].side == Side::kI ? i : j).Ad * X.term[0].s;
    return j.rd + j.Ad * X.term[0].s - i.rd - i.Ad * X.term[1].s;
  };
  for (const Joint& joint : joints_) {
    T* out = product + joint.row;
    if (joint.rows.coincident) {
      const BodyKinematics<T>&i = bodies_[joint.i], &j = bodies_[joint.j];
      const Vector3<T> d = j.rd + j.Ad * joint.rows.s_j - i.rd - i.Ad * joint.rows.s_i;
      for (int k = 0; k < 3; ++k) *out++ = d[k];
    }
    for (const ProductRow<T>& row : joint.rows.products)
      *out++ =
          T(row.scale) * (dot(rate(row.X, joint), value_of_vector(row.Y, joint)) + dot(value_of_vector(row.X, joint), rate(row.Y, joint)));
  }
  for (int b = 0; b < layout_.bodies; ++b) {
    const BodyKinematics<T>& k = bodies_[static_cast<std::size_t>(b)];
    product[layout_.norm_row(b)] = k.p[0] * k.pd[0] + k.p[1] * k.pd[1] + k.p[2] * k.pd[2] + k.p[3] * k.pd[3];
  }
}

template <class T>
void ConstraintKernels<T>::transposed_times(const T* q, const T* lambda, T* product) {
  load_positions(q);
  for (BodyLoad<T>& load : loads_) {
    load.force.setZero();
    load.W.setZero();
  }
  for (const Joint& joint : joints_) {
    const T* l = lambda + joint.row;
    BodyLoad<T>*i = &loads_[joint.i], *j = &loads_[joint.j];
    if (joint.rows.coincident) {
      add_vector_load(PairVector<T>::displacement(joint.rows.s_i, joint.rows.s_j), Vector3<T>(l[0], l[1], l[2]), i, j);
      l += 3;
    }
    for (const ProductRow<T>& row : joint.rows.products) {
      const T weight = T(row.scale) * *l++;
      add_vector_load(row.X, Vector3<T>(weight * value_of_vector(row.Y, joint)), i, j);
      add_vector_load(row.Y, Vector3<T>(weight * value_of_vector(row.X, joint)), i, j);
    }
  }
  for (int b = 0; b < layout_.bodies; ++b, product += kBodySize) {
    const auto k = static_cast<std::size_t>(b);
    const Vector4<T> on_p = rotation_hessian(loads_[k].W) * bodies_[k].p + lambda[layout_.norm_row(b)] * bodies_[k].p;
    for (int c = 0; c < 3; ++c) product[c] = loads_[k].force[c];
    for (int c = 0; c < 4; ++c) product[3 + c] = on_p[c];
  }
}

template <class T>
void ConstraintKernels<T>::curvature(const T* q, const T* v, T* product) {
  load_positions(q);
  load_velocities(v);
  for (int b = 0; b < layout_.bodies; ++b) {
    BodyKinematics<T>& body = bodies_[static_cast<std::size_t>(b)];
    body.Add = T(2.0) * rotation(body.pd);
  }
  for (const Joint& joint : joints_) {
    const BodyKinematics<T>&i = bodies_[joint.i], &j = bodies_[joint.j];
    T* out = product + joint.row;
    if (joint.rows.coincident) {
      const Vector3<T> d = j.Add * joint.rows.s_j - i.Add * joint.rows.s_i;
      for (int k = 0; k < 3; ++k) *out++ = d[k];
    }
    for (const ProductRow<T>& row : joint.rows.products)
      *out++ = T(row.scale) * product_motion(motion_of(row.X, i, j), motion_of(row.Y, i, j)).phidd;
  }
  for (int b = 0; b < layout_.bodies; ++b) {
    const Vector4<T>& pd = bodies_[static_cast<std::size_t>(b)].pd;
    product[layout_.norm_row(b)] = pd[0] * pd[0] + pd[1] * pd[1] + pd[2] * pd[2] + pd[3] * pd[3];
  }
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_BENCHMARK_CONSTRAINT_KERNELS_H_
