// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Velocities of a start that the study gives in part, or that a loop forbids.
#include "assembly/start_velocities.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "assembly/loops_to_close.h"
#include "equations/formulas.h"

namespace codesign {
namespace {

/// Two bars on each other; a rod holds the end of a lever on the second one to a point on the line
/// through the second hinge and that end, so that the hinge has no lever.
std::string arm_at_a_dead_centre() {
  return robot(bar("upper") + bar("lower") + hinge("shoulder", "ground", "upper", "0 0 0") +
               hinge("elbow", "upper", "lower", "0 0 -1") +
               "<loop name='rod' type='codesign:distance'><predecessor link='ground'><origin "
               "xyz='2.1 0 -0.7'/></predecessor><successor link='lower'><origin xyz='0.7 0 "
               "0.1'/></successor><codesign:length value='1.4142135623730951'/></loop>");
}

TEST(StartVelocities, WhatALoopForbidsByALeverOfRoundingIsSaid) {
  for (const char* coordinates : {"absolute", "joint"})
    for (const char* velocity : {"-0.16", "3.0", "1e-6"}) {
      Compiled c(arm_at_a_dead_centre(),
                 std::string("duration: 1.0\ninitial_state: {shoulder: {position: 0, velocity: ") +
                     velocity + "}, elbow: {position: 0}}\nsolver: {coordinates: " + coordinates +
                     ", closure_tolerance: 0.1}\n");
      const Status status = c.start();
      EXPECT_EQ(status.code, StatusCode::kInitialVelocityFailed) << status.cause;
      for (const char* part : {"'rod'", "'shoulder'"})
        EXPECT_NE(status.cause.find(part), std::string::npos) << status.cause;
    }
}

/// A plate on three legs, each of which turns in a universal joint on the ground and is held to the
/// plate by a ball at its tip.
std::string plate_on_legs() {
  std::string text = bar("plate") +
                     "<joint name='free' type='floating'><parent link='ground'/><child "
                     "link='plate'/><origin xyz='0 0 1'/></joint>";
  const char* const at[] = {"0.3 0 0", "-0.2 0.3 0", "-0.2 -0.25 0"};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const std::string k = std::to_string(leg);
    text += "<link name='a" + k + "'/>" + bar("rod" + k) + bar("end" + k);
    text += "<joint name='u" + k + "' type='continuous'><parent link='ground'/><child link='a" + k +
            "'/><origin xyz='" + at[leg] + "'/><axis xyz='1 0 0'/></joint><joint name='v" + k +
            "' type='continuous'><parent link='a" + k + "'/><child link='rod" + k +
            "'/><axis xyz='0 1 0'/></joint><joint name='leg" + k +
            "' type='prismatic'><parent link='rod" + k + "'/><child link='end" + k +
            "'/><origin xyz='0 0 1'/><axis xyz='0 0 1'/><limit lower='-9' upper='9' effort='9' "
            "velocity='9'/></joint><loop name='top" +
            k + "' type='codesign:spherical'><predecessor link='end" + k +
            "'/><successor link='plate'><origin xyz='" + at[leg] + "'/></successor></loop>";
  }
  return robot(text);
}

// The legs can follow any motion of the plate: what is not given of it rests.
TEST(StartVelocities, WhatAFloatingJointDoesNotSayRests) {
  for (const char* given :
       {"angular_velocity: [0.5, 0.3, 1.0]", "linear_velocity: [0.1, -0.2, 0.4]",
        "translation: [0.01, 0, 0.02], angular_velocity: [0.5, 0.3, 1.0]"}) {
    Compiled c(plate_on_legs(),
               std::string("duration: 1.0\ninitial_state: {free: {") + given + "}}\n");
    const Status status = c.start();
    ASSERT_TRUE(status.ok()) << status.cause;
    const auto value = [&c](const std::string& text) {
      return c.equations.formulas().signal(
          resolve_signal(parse_signal(text, {}, "test"), c.system.robot(), c.system.topology(), {}),
          c.state);
    };
    const bool turns = std::string(given).find("angular") != std::string::npos;
    const double linear[] = {turns ? 0.0 : 0.1, turns ? 0.0 : -0.2, turns ? 0.0 : 0.4},
                 angular[] = {turns ? 0.5 : 0.0, turns ? 0.3 : 0.0, turns ? 1.0 : 0.0};
    for (int k = 0; k < 3; ++k) {
      const std::string axis = std::string("/") + "xyz"[k];
      EXPECT_NEAR(value("plate/velocity" + axis), linear[k], 1e-9) << given << axis;
      EXPECT_NEAR(value("plate/angular_velocity" + axis), angular[k], 1e-9) << given << axis;
    }
  }
}

TEST(StartVelocities, FollowThoseThatAreGiven) {
  LoopsToClose c(four_bar(), "{left_hinge: {position: 0.6, velocity: 2.0}}");
  StartVelocities velocities(c.loops);
  StartDependents dependents;
  std::vector<std::size_t> contradicting;
  Posture posture = c.at({0.6, 0.6, -0.6});
  posture.rate << 2.0, 0.0, 0.0;
  ASSERT_TRUE(velocities.find(c.design, &posture, &dependents, &contradicting).ok());
  EXPECT_LT((posture.rate - Eigen::Vector3d(2.0, 2.0, -2.0)).norm(), 1e-12);
  EXPECT_EQ(dependents.positions.columns, (std::vector<int>{1, 2}));
  EXPECT_EQ(dependents.velocities.columns, (std::vector<int>{1, 2}));
  // A coordinate whose rate is given does not follow, and then the loop cannot.
  posture.given.velocity[1] = posture.given.velocity[2] = true;
  posture.rate << 2.0, 1.0, 0.0;
  EXPECT_EQ(velocities.find(c.design, &posture, &dependents, &contradicting).code,
            StatusCode::kInitialVelocityFailed);
  EXPECT_EQ(contradicting, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace codesign
