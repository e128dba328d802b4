// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_FRICTION_STATE_H_
#define MECHANISM_CODESIGN_ELEMENTS_FRICTION_STATE_H_

namespace codesign {

/// The friction of one joint coordinate at one instant.
template <class T>
struct FrictionState {
  T velocity{0.0};  ///< of the child along or about the axis [m/s or rad/s]
  T normal{0.0};    ///< normal force N [N]
  T load{0.0};      ///< the joint's load against the motion, S(v) N [N or N m]; the child feels -load
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_FRICTION_STATE_H_
