// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/integrator.h"

#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/idas_integrator.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(Integrator, TheStudyChooses) {
  const auto rosenbrock = servo("{integrator: rosenbrock}"), idas = servo("{integrator: idas}");
  EXPECT_NE(dynamic_cast<RosenbrockIntegrator*>(make_integrator(*rosenbrock).get()), nullptr);
  EXPECT_NE(dynamic_cast<IdasIntegrator*>(make_integrator(*idas).get()), nullptr);
}

TEST(Integrator, BothBeginAtTheAssembledStart) {
  State<double> start[2];
  int k = 0;
  for (const char* solver : {"{integrator: rosenbrock}", "{integrator: idas}"}) {
    const auto system = servo(solver);
    const auto integrator = make_integrator(*system);
    ASSERT_TRUE(integrator->start(system->parameters()).ok());
    State<double> sample = start[k] = integrator->state();
    double psi = 1.0;
    integrator->interpolate(0.0, &sample, &psi);
    EXPECT_EQ(sample.q, integrator->state().q);
    EXPECT_EQ(sample.z, integrator->state().z);
    EXPECT_EQ(psi, 0.0);
    EXPECT_EQ(integrator->statistics().steps, 0);
    ++k;
  }
  EXPECT_EQ(start[0].q, start[1].q);
  EXPECT_EQ(start[0].z, start[1].z);
}

}  // namespace
}  // namespace codesign
