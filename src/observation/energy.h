// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "equations/equations.h"
#include "equations/formulas.h"

namespace codesign {

// Mechanical energy and its power balance, doc/theory.md (14b), (14c). Along any motion
//   d mechanical_energy().total() / dt = mechanical_power().total().

/// Mechanical energy [J].
struct Energy {
  double kinetic = 0.0;  ///< of bodies and rotors
  /// gravity (zero at the root's origin), torsion springs, spring-dampers, stops, elastic gears;
  /// without bristles of friction laws
  double potential = 0.0;

  double total() const { return kinetic + potential; }
};

/// Power that enters the mechanism [W]; negative if energy leaves it.
struct Power {
  double friction = 0.0, damping = 0.0, actuators = 0.0, loads = 0.0;  ///< the kinds of PowerKind

  double total() const { return friction + damping + actuators + loads; }
};

/// Energy of the loaded state, (14b). @param equations must have loaded a state with
/// Equations::load(). No allocation once warm.
inline Energy mechanical_energy(const Equations<double>& equations) {
  return {equations.formulas().kinetic_energy(), equations.formulas().potential_energy()};
}

/// Power in the loaded state, (14c). Friction depends on the reactions, so that the state's
/// multipliers must be consistent. No allocation once warm.
inline Power mechanical_power(Equations<double>* equations) {
  return {equations->formulas().power(PowerKind::kFriction),
          equations->formulas().power(PowerKind::kDamping),
          equations->formulas().power(PowerKind::kActuator),
          equations->formulas().power(PowerKind::kLoad)};
}

}  // namespace codesign
