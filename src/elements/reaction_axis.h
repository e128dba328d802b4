// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/local_row.h"

namespace codesign {

/// One component of the wrench of a joint on its child: the force along, or the torque about, an axis of the joint frame that the child
/// carries; theory (11a).
template <class T>
struct ReactionAxis {
  int pair = -1;
  Side side = Side::kJ;  ///< side of the pair that the child is on
  int body = -1;         ///< the child; -1 if it is the ground
  bool torque = false;   ///< torque about the axis through s, else force along the axis
  Vector3<T> e, s;       ///< axis and origin of the joint frame, in body coordinates

  /// The vector d of (11a) in body axes: a load b on the child's vector A s_t contributes (A d) . b to the component. d is e for a force,
  /// e x (s_t - s) for a torque and a point, e x s_t for a torque and a direction. @param point whether A s_t is a point or a direction.
  Vector3<T> lever(const Vector3<T>& s_t, bool point) const {
    if (!torque) return e;
    return cross<T>(e, point ? Vector3<T>(s_t - s) : s_t);
  }
};

}  // namespace codesign
