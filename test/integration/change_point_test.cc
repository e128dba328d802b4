// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Given motions through positions where several motions of a loop meet.
#include "assembly/change_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/assembly.h"
#include "equations/compiled_system.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A linkage of cranks of 0.1 m and `follower`, 0.3 m apart along x, and a coupler of `coupler`; if
/// it is a parallelogram, it lies flat where the crank is at pi/2.
Problem driven_linkage(const std::string& motion, const std::string& follower = "0.1",
                       const std::string& coupler = "0.3", const std::string& more = "") {
  const auto link = [](const std::string& name, const std::string& at) {
    return "<link name='" + name + "'><inertial><origin xyz='" + at +
           "'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.001' iyz='0' "
           "izz='0.001'/></inertial></link>";
  };
  const auto pin = [](const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& at) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + at + "'/><axis xyz='0 1 0'/></joint>";
  };
  return load_problem(
      {"linkage.urdf",
       "<robot name='r' xmlns:codesign='urn:mechanism_codesign'><link name='g'/>" +
           link("cr", "0 0 0.05") + link("co", "0.1 0 0") + link("fo", "0 0 0.05") +
           pin("crank", "g", "cr", "0 0 0") + pin("knee", "cr", "co", "0 0 0.1") +
           pin("foll", "g", "fo", "0.3 0 0") +
           "<loop name='pin' type='revolute' codesign:out_of_plane='zero'><predecessor "
           "link='co'><origin xyz='" +
           coupler + " 0 0'/></predecessor><successor link='fo'><origin xyz='0 0 " + follower +
           "'/></successor><axis xyz='0 1 0'/></loop></robot>"},
      {},
      {"linkage.yaml", "duration: 6\ngravity: [0, 0, 0]\nmotion: {crank: {position: \"${" + motion +
                           "}\"}}\ninitial_state: {foll: {guess: 0.3}}\n" + more});
}

bool tells_change_point(const Problem& problem) {
  return std::any_of(problem.warnings().begin(), problem.warnings().end(),
                     [](const Warning& warning) { return warning.code == "change_point"; });
}

TEST(ChangePoint, IsWhereTheParallelogramLiesFlat) {
  for (const double speed : {0.5, 5.0}) {
    const Problem problem = driven_linkage("0.3 + " + std::to_string(speed) + "*t");
    StartWorkspace start(*system_of(problem), problem.parameters());
    ASSERT_TRUE(start.solve_positions().ok());
    const std::optional<double> time = first_change_point(*system_of(problem), &start);
    ASSERT_TRUE(time);
    EXPECT_NEAR(0.3 + speed * *time, M_PI / 2.0, 0.2);
    EXPECT_TRUE(tells_change_point(problem));
  }
  EXPECT_FALSE(tells_change_point(driven_linkage("0.3 + 0.2*sin(t)"))) << "never flat";
  EXPECT_FALSE(tells_change_point(driven_linkage("0.3 + 5*t", "0.2", "0.25")))
      << "a crank and a rocker";
}

// The follower turns with the crank through more than three flat positions, however close to them
// the steps end.
TEST(ChangePoint, ARunGoesOnBeyondIt) {
  for (const char* motion : {"0.3 + 5*t", "0.31 + 4.7*t", "0.3 + 2*t"}) {
    const Problem problem =
        driven_linkage(motion, "0.1", "0.3",
                       "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n");
    Simulation simulation(problem, problem.parameters(), {"crank/position", "foll/position"});
    const Status status = simulate(&simulation, 6.0, 61, [&](const Frame& frame) {
      EXPECT_NEAR(frame.signals[0], frame.signals[1], 1e-5) << motion << " " << frame.time;
      return true;
    });
    EXPECT_TRUE(status.ok()) << motion << ": " << status.cause;
  }
}

}  // namespace
}  // namespace codesign
