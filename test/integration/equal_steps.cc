// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/equal_steps.h"

namespace codesign {

void take_equal_steps(const CompiledSystem& system, double span, int count, OneStep<double>* step) {
  Assembly assembly(system);
  State<double> initial;
  step->equations().set_design(system.parameters());
  EXPECT_TRUE(assembly.solve(system.parameters(), &step->equations(), &initial).ok());
  step->start(initial);
  for (int k = 0; k < count; ++k) {
    EXPECT_TRUE(step->attempt(span / count));
    EXPECT_TRUE(step->accept());
  }
}

}  // namespace codesign
