// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OBSERVATION_ENERGY_H_
#define MECHANISM_CODESIGN_OBSERVATION_ENERGY_H_

#include "equations/equations.h"

namespace codesign {

// Where the energy of a motion is and goes, doc/theory.md (14b), (14c). Along any motion
//   d mechanical_energy().total() / dt = mechanical_power().total().

/// Mechanical energy [J].
struct Energy {
  double kinetic = 0.0;    ///< of bodies and rotors
  double potential = 0.0;  ///< gravity, torsion springs, spring-dampers, the depth of stops; not what bristles of friction laws hold

  double total() const { return kinetic + potential; }
};

/// Power that goes into the mechanism [W]; what it loses is negative.
struct Power {
  double friction = 0.0, damping = 0.0, actuators = 0.0, loads = 0.0;  ///< see PowerKind

  double total() const { return friction + damping + actuators + loads; }
};

/// @param equations must have loaded a state with its accelerations and reactions: Equations::load(). No allocation once warm.
inline Energy mechanical_energy(const Equations<double>& equations) {
  return {equations.formulas().kinetic_energy(nullptr), equations.formulas().potential_energy(nullptr)};
}

/// As mechanical_energy(). Friction depends on reactions, so that the state's multipliers count.
inline Power mechanical_power(Equations<double>* equations) {
  return {equations->formulas().power(PowerKind::kFriction, nullptr), equations->formulas().power(PowerKind::kDamping, nullptr),
          equations->formulas().power(PowerKind::kActuator, nullptr), equations->formulas().power(PowerKind::kLoad, nullptr)};
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OBSERVATION_ENERGY_H_
