// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace codesign {

/// The kinds of power that go into a mechanism, doc/theory.md (14c); their sum is the rate of the mechanical energy. Gravity, springs and
/// the elastic part of stops are not among them, since their work is in the potential energy.
enum class PowerKind {
  kFriction,  ///< `<codesign:friction>` with its viscous part, and `<dynamics friction>`
  kDamping,   ///< `<dynamics damping>`, the dampers of torsion springs and spring-dampers, and the dissipation of stops
  kActuator,  ///< controllers, as applied within the effort limits
  kLoad       ///< the study's constant efforts and wrenches
};

}  // namespace codesign
