// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_

#include "equations_assembly.h"
#include "equations_bristles.h"
#include "equations_constant_loads.h"
#include "equations_contacts.h"
#include "equations_controllers.h"
#include "equations_couplings.h"
#include "equations_energy.h"
#include "equations_limits.h"
#include "equations_loads.h"
#include "equations_power.h"
#include "equations_reactions.h"
#include "equations_residual.h"
#include "equations_rotors.h"
#include "equations_sharing.h"
#include "equations_signals.h"
#include "equations_springs.h"

/// One source file per scalar, so that they compile side by side.
#define CODESIGN_INSTANTIATE_EQUATIONS(T) template class Equations<T>;

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_
