// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/solver_options.h"

#include <gtest/gtest.h>

#include "description/solver_names.h"

namespace codesign {
namespace {

TEST(SolverNames, AreInTheOrderOfTheEnumerators) {
  EXPECT_EQ(integrator_named("rosenbrock"), IntegratorKind::kRosenbrock);
  EXPECT_EQ(integrator_named("idas"), IntegratorKind::kIdas);
  EXPECT_EQ(method_named("rodas4"), RosenbrockMethod::kRodas4);
  EXPECT_EQ(method_named("rodas4p2"), RosenbrockMethod::kRodas4P2);
  EXPECT_EQ(method_named("rodas5p"), RosenbrockMethod::kRodas5P);
  EXPECT_EQ(gradient_named("auto"), GradientMethod::kAuto);
  EXPECT_EQ(gradient_named("direct"), GradientMethod::kDirect);
  EXPECT_EQ(gradient_named("adjoint"), GradientMethod::kAdjoint);
  EXPECT_THROW(method_named("rodas6"), std::invalid_argument);
}

}  // namespace
}  // namespace codesign
