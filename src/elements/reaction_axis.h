// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_REACTION_AXIS_H_
#define MECHANISM_CODESIGN_ELEMENTS_REACTION_AXIS_H_

#include "joints/local_row.h"

namespace codesign {

/// One component of what a joint exerts on its child, along an axis of the joint frame that the child carries; theory (11a).
template <class T>
struct ReactionAxis {
  int pair = -1;
  Side side = Side::kJ;  ///< of the child
  int body = -1;         ///< of the child; -1: the ground
  bool torque = false;   ///< about the axis through s, else force along it
  Vector3<T> e, s;       ///< axis and origin of the joint frame, in body coordinates

  /// d, so that b at (or, of a direction, with) the child's vector A s_t has the component (A d) . b.
  Vector3<T> lever(const Vector3<T>& s_t, bool point) const {
    if (!torque) return e;
    return cross<T>(e, point ? Vector3<T>(s_t - s) : s_t);
  }
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_REACTION_AXIS_H_
