// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_POWER_KIND_H_
#define MECHANISM_CODESIGN_ELEMENTS_POWER_KIND_H_

namespace codesign {

/// Who does work on a mechanism. Gravity, springs and the elasticity of stops are left out: what they do is in the potential energy, so
/// that (kinetic + potential)' is the sum of these powers; doc/theory.md (14c).
enum class PowerKind {
  kFriction,  ///< `<codesign:friction>` with its viscous part, and `<dynamics friction>`
  kDamping,   ///< `<dynamics damping>`, the dampers of torsion springs and spring-dampers, and what stops dissipate
  kActuator,  ///< controllers, as applied within the effort limits
  kLoad       ///< the study's constant efforts and wrenches
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_POWER_KIND_H_
