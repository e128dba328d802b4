// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The friction of one joint coordinate at one instant, for observers; theory (13).
template <class T>
struct FrictionState {
  T velocity{0.0};  ///< rate of the coordinate, child relative to parent [m/s or rad/s]
  T normal{0.0};    ///< normal force N [N]; zero for `<dynamics friction>`
  T load{0.0};      ///< L, positive against the motion, viscous part included [N or N m]; the child feels -L
};

}  // namespace codesign
