// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/parameter_lanes.h"

#include "sensitivity/servo_steps.h"

namespace codesign {
namespace {

// psi_rho = psi_y y_rho at the start + the sums of ParameterLanes, for the gains and the weight.
TEST(ParameterLanes, IsWhatTheStartDoesNotExplain) {
  ServoSteps run("rodas4p2");
  const LanePlan plan = plan_lanes(*run.system);
  ASSERT_LT(plan.lanes, 4);
  ParameterLanes<4> lanes(*run.system, {0, plan.lanes}, plan);
  lanes.start(run.parameters);
  const Eigen::Index size = run.end.cols(), psi = size - 1;
  const VectorX<double>& start = run.back(VectorX<double>::Unit(size, psi), [&](std::size_t k) {
    if (k + 1 < run.points.size()) lanes.add_stages(run.adjoint);
    if (k > 0) lanes.add_projection(run.adjoint);
    lanes.add_matrices(run.points[k], run.adjoint);
  });
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(5);
  lanes.collect(&gradient);
  EXPECT_TRUE(lanes.plan_holds());
  for (Eigen::Index k = 0; k < 5; ++k) {
    const VectorX<double> begin = run.begin.row(k).transpose();
    const double expected = run.end(k, psi);
    EXPECT_NEAR(gradient[k] + start.dot(begin), expected, 1e-12 * std::abs(expected)) << k;
  }
  // All parameters act on the motion or the integrand, except for the position of the start.
  for (Eigen::Index k : {0, 1, 2, 4}) EXPECT_NE(gradient[k], 0.0) << k;
  EXPECT_EQ(gradient[3], 0.0);
}

}  // namespace
}  // namespace codesign
