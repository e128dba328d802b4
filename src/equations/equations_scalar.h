// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_

#include "equations/equations_assembly.h"
#include "equations/equations_bristles.h"
#include "equations/equations_constant_loads.h"
#include "equations/equations_contacts.h"
#include "equations/equations_controllers.h"
#include "equations/equations_couplings.h"
#include "equations/equations_energy.h"
#include "equations/equations_limits.h"
#include "equations/equations_loads.h"
#include "equations/equations_power.h"
#include "equations/equations_reactions.h"
#include "equations/equations_residual.h"
#include "equations/equations_rotors.h"
#include "equations/equations_sharing.h"
#include "equations/equations_signals.h"
#include "equations/equations_springs.h"

/// One source file per scalar, so that they compile side by side.
#define CODESIGN_INSTANTIATE_EQUATIONS(T) template class Equations<T>;

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_SCALAR_H_
