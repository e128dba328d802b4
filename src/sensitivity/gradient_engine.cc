// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/sensitivity/gradient_engine.h"

#include "mechanism_codesign/dynamics/system.h"
#include "sensitivity/idas_gradient.h"
#include "sensitivity/rosenbrock_gradient.h"

namespace codesign {

std::unique_ptr<GradientEngine> make_gradient_engine(const System& system) {
  if (system.study().solver.integrator == "idas") return std::make_unique<IdasGradient>(system);
  return std::make_unique<RosenbrockGradient>(system);
}

}  // namespace codesign
