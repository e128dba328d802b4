// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/standstill.h"

#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/integrator.h"
#include "integration/rounded_linkages.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct End {
  Status status;
  Statistics statistics;
};

End run(const std::string& urdf, const std::string& study) {
  const Problem problem = load_problem({"rounded.urdf", urdf}, {}, {"rounded.yaml", study});
  const auto integrator = make_integrator(*problem.system());
  Status status = integrator->start(problem.parameters());
  while (status.ok() && integrator->state().t < problem.study().duration) status = integrator->advance(problem.study().duration);
  return {status, integrator->statistics()};
}

TEST(Standstill, FrictionBeforeASingularPositionEndsTheRunWithItsTimeRankAndJoints) {
  for (double tolerance : {1e-6, 1e-8}) {
    const End end = run(rounded::three_cranks(), rounded::study(rounded::three_cranks_start(), "j0/velocity", 1.0, tolerance));
    EXPECT_EQ(end.status.code, StatusCode::kSingularConfiguration) << end.status.cause;
    EXPECT_NEAR(end.status.time, 0.3401, 1e-3);
    EXPECT_NE(end.status.cause.find("singular position"), std::string::npos) << end.status.cause;
    EXPECT_NE(end.status.cause.find("the friction of 'j0'"), std::string::npos) << end.status.cause;
    EXPECT_NE(end.status.cause.find("'close"), std::string::npos) << end.status.cause;
    EXPECT_LT(end.statistics.steps, 5000);
  }
}

TEST(Standstill, ARunThatNeverComesNearIsLeftAlone) {
  const End end = run(rounded::three_cranks(), rounded::study(rounded::three_cranks_start(), "j0/velocity", 0.1, 1e-6));
  EXPECT_TRUE(end.status.ok()) << end.status.cause;
}

TEST(Standstill, ARingWhoseRowsTakeTurnsIsNotCalledSingular) {
  const End end = run(rounded::bennett(), rounded::study(rounded::bennett_start(), "t1/velocity", 1.0, 1e-7));
  EXPECT_EQ(end.status.code, StatusCode::kSingularConfiguration) << end.status.cause;
  EXPECT_NEAR(end.status.time, 0.6803, 2e-3);
  EXPECT_NE(end.status.cause.find("although all constraints together keep their rank"), std::string::npos) << end.status.cause;
}

}  // namespace
}  // namespace codesign
