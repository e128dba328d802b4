// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "assembly/make_system.h"
#include "description/study.h"
#include "equations/formulas.h"
#include "integration/mechanisms.h"
#include "integration/rosenbrock_integrator.h"
#include "observation/energy.h"

namespace codesign {

struct Balance {
  double start = 0.0, largest_drift = 0.0, end = 0.0;
  double friction_work = 0.0;  ///< lost to friction
  double work = 0.0;           ///< that went into the mechanism in all
  Status status;
};

/// Runs a study, adding up work by Gauss quadrature within each step.
Balance balance(const std::string& urdf, const std::string& study_text);

/// Tolerances for motions without friction, and with it.
inline const char* const kTight =
    "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: "
    "1.0e-12}";
inline const char* const kFriction =
    "{integrator: rosenbrock, method: rodas5p, relative_tolerance: 1.0e-9, absolute_tolerance: "
    "1.0e-10}";

}  // namespace codesign
