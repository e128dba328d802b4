// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "integration/servo.h"
#include "integration/step_method.h"

namespace codesign {

/// What a step of the servo works on, at the start of its study.
struct ServoMemory {
  explicit ServoMemory(const RosenbrockTableau& tableau) : memory(*system, tableau) {
    Assembly assembly(*system);
    memory.equations.set_design(system->parameters());
    EXPECT_TRUE(assembly.solve(system->parameters(), &memory.equations, &memory.state).ok());
    memory.end = memory.state;
  }

  /// The part of an increment from an entry on.
  static Eigen::VectorXd part(const VectorX<double>& u, int first, int size) {
    return u.segment(first, size);
  }
  /// G, without the integrand, at a state.
  Eigen::VectorXd residual(const State<double>& at) {
    VectorX<double> G;
    double g = 0.0;
    memory.equations.residual(at, &G, &g);
    return G.head(memory.at.z_size);
  }

  const std::shared_ptr<const CompiledSystem> system = servo("{integrator: rosenbrock}");
  StepMemory<double> memory;
};

}  // namespace codesign
