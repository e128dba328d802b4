// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "equations/compiled_system.h"
#include "integration/idas_equations.h"
#include "integration/idas_newton.h"

namespace codesign {

/// The memory of IDAS, its context, and the text of its last message.
struct IdasMemory {
  void* ida;
  SUNContext context;
  std::string* message;
};

/// The vectors y = (q, v, s, lambda), y' and the integrals that IDAS works on.
struct IdasVectors {
  N_Vector y, y_dot, integrals;
};

/// Gives IDAS equations, tolerances, steps and linear solver of a study. All arguments must outlive
/// its memory.
void set_up_idas(const IdasMemory& memory, const CompiledSystem& system, IdasEquations* equations,
                 IdasNewton* newton, const IdasVectors& vectors);

}  // namespace codesign
