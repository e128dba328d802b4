// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "joints/body_kinematics.h"
#include "joints/pair_rows.h"

namespace codesign {

/// Generic values of [r_i, p_i, r_j, p_j] or of a time derivative. |p| differs from 1, where the
/// formulas must hold too.
inline Eigen::VectorXd generic_local(double phase) {
  Eigen::VectorXd x(kLocalSize);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = 0.6 * std::sin(2.3 * static_cast<double>(k) + phase);
  return x;
}

/// One body of a pair; its coordinates begin at index `first`.
template <class T>
BodyKinematics<T> local_body(const VectorX<T>& q, const VectorX<T>& v, const VectorX<T>& a,
                             int first) {
  BodyKinematics<T> b;
  b.r = q.template segment<3>(first);
  b.p = q.template segment<4>(first + 3);
  b.rd = v.template segment<3>(first);
  b.pd = v.template segment<4>(first + 3);
  b.rdd = a.template segment<3>(first);
  b.pdd = a.template segment<4>(first + 3);
  b.update_rotation();
  return b;
}

}  // namespace codesign
