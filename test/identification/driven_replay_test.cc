// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/driven_replay.h"

#include <gtest/gtest.h>

#include "cases/shipped.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

Eigen::VectorXd column_of(double value) { return Eigen::VectorXd::Constant(1, value); }

double largest_difference(const Frame& a, const Frame& b) {
  double largest = 0.0;
  const auto add = [&](double x, double y) { largest = std::max(largest, std::abs(x - y) / (1.0 + std::abs(x))); };
  for (std::size_t k = 0; k < a.joints.size(); ++k) {
    add(a.joints[k].position, b.joints[k].position);
    add(a.joints[k].velocity, b.joints[k].velocity);
    add(a.joints[k].effort, b.joints[k].effort);
  }
  for (std::size_t k = 0; k < a.frictions.size(); ++k) {
    add(a.frictions[k].friction, b.frictions[k].friction);
    add(a.frictions[k].normal_force, b.frictions[k].normal_force);
    add(0.0, (a.frictions[k].force - b.frictions[k].force).norm());
  }
  for (std::size_t k = 0; k < a.links.size(); ++k) {
    add(0.0, (a.links[k].position - b.links[k].position).norm());
    add(0.0, a.links[k].orientation.angularDistance(b.links[k].orientation));
  }
  return largest;
}

// The crank alone is given; passive joints, the loop, friction by reactions and the motor's effort are found again.
TEST(DrivenReplay, ShowsWhatWasSimulated) {
  const Problem problem = shipped_problem("slider_crank", {});
  Simulation simulation(problem, problem.parameters());
  ASSERT_TRUE(simulation.start().ok());
  DrivenReplay replay(*problem.system(), {{"crank_joint", true, 1.0, {}}}, Eigen::MatrixXd::Zero(1, 1), problem.parameters());
  ASSERT_EQ(replay.names().joints, simulation.names().joints);
  ASSERT_EQ(replay.names().frictions, simulation.names().frictions);
  ASSERT_EQ(replay.names().joints[0], "crank_joint");
  for (int k = 0; k <= 40; ++k) {
    Frame simulated, shown;
    ASSERT_TRUE(simulation.advance(0.005 * k).ok());
    simulation.sample(0.005 * k, &simulated);
    const JointSample& crank = simulated.joints[0];
    if (k == 0) {
      ASSERT_TRUE(replay.begin(column_of(crank.position)).ok());
    }
    const Eigen::VectorXd measured[] = {column_of(crank.position), column_of(crank.velocity), column_of(crank.acceleration)};
    const Status status = replay.show(measured, &shown);
    ASSERT_TRUE(status.ok()) << status.cause;
    ASSERT_EQ(shown.frictions.size(), simulated.frictions.size());
    EXPECT_LT(largest_difference(simulated, shown), 1e-5) << "t = " << 0.005 * k;
    EXPECT_GT(std::abs(shown.frictions[0].friction), 1e-3);
  }
}

TEST(DrivenReplay, APositionThatCannotBeAssembledIsAStatus) {
  const Problem problem = shipped_problem("slider_crank", {});
  DrivenReplay replay(*problem.system(), {{"slider_joint", true, 1.0, {}}}, Eigen::MatrixXd::Zero(1, 1), problem.parameters());
  EXPECT_EQ(replay.begin(column_of(100.0)).code, StatusCode::kAssemblyFailed) << "the rod does not reach";
}

}  // namespace
}  // namespace codesign
