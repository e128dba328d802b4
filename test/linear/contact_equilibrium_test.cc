// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Mechanisms that come to stand on contacts.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/mechanisms.h"
#include "linear/equilibrium.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kGravity = 9.81;

Equilibrium standing(const std::string& urdf, const std::string& study,
                     const std::vector<std::string>& signals) {
  const Problem problem = load_problem({"stand.urdf", urdf}, {}, {"stand.yaml", study}, {},
                                       TrajectoryLoader(), FileLoader());
  std::vector<SignalDescription> read;
  for (const std::string& signal : signals) read.push_back(parse_signal(signal, {}, "signals"));
  return find_equilibrium(*system_of(problem), problem.parameters(), read);
}

// A ball on a slide, from the air: k delta^(3/2) = m g.
TEST(ContactEquilibrium, ABallStandsOnTheFloor) {
  const std::string urdf = robot(
      "<link name='ball'><inertial><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' "
      "iyy='0.001' iyz='0' izz='0.001'/></inertial></link><joint name='fall' type='prismatic'>"
      "<parent link='ground'/><child link='ball'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' "
      "effort='0' velocity='0'/></joint><codesign:contact name='touch' stiffness='1e6' "
      "dissipation='0.3'><predecessor link='ground' shape='plane'/><successor link='ball' "
      "shape='sphere' radius='0.05'/></codesign:contact>");
  for (const char* start : {"0.3", "0.0499"}) {
    const Equilibrium found = standing(
        urdf, "duration: 1\ninitial_state: {fall: {position: " + std::string(start) + "}}\n",
        {"touch/normal_force", "touch/gap"});
    ASSERT_TRUE(found.status.ok()) << start << found.status.cause;
    const double depth = std::pow(kGravity / 1e6, 2.0 / 3.0);
    EXPECT_NEAR(found.frame.signals[0], kGravity, 1e-7) << start;
    EXPECT_NEAR(found.frame.signals[1], -depth, 1e-10) << start;
    EXPECT_EQ(found.linear.stability, Stability::kStable) << start;
  }
}

}  // namespace
}  // namespace codesign
