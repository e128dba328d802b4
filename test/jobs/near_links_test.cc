// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/near_links.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

SolidBox box_at(double x, double y, double turn = 0.0) {
  SolidBox box;
  box.pose = Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  box.half = {0.1, 0.2, 0.3};
  return box;
}

TEST(NearLinks, DistanceOfBoxesByHand) {
  EXPECT_NEAR(box_distance(box_at(0, 0), box_at(0.5, 0)), 0.3, 1e-15);
  EXPECT_NEAR(box_distance(box_at(0, 0), box_at(0, -0.5)), 0.1, 1e-15);
  EXPECT_EQ(box_distance(box_at(0, 0), box_at(0.15, 0.3)), 0.0);
  // Turned by 45 degrees it reaches (0.1 + 0.2)/sqrt 2 along x.
  EXPECT_NEAR(box_distance(box_at(0, 0), box_at(0.5, 0, 0.25 * std::acos(-1.0))),
              0.4 - 0.3 * std::sqrt(0.5), 1e-15);
}

std::string link(const std::string& name, const std::string& z, const std::string& more = "") {
  return "<link name='" + name +
         "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
         "izz='1'/></inertial><collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>"
         "</link><joint name='to_" +
         name + "' type='continuous'><parent link='ground'/><child link='" + name +
         "'/><origin xyz='0 0 " + z + "'/></joint>" + more;
}

std::vector<NearLinks> near_links(const std::string& content) {
  const Problem problem =
      load_problem({"near.urdf",
                    "<robot name='near' xmlns:codesign='urn:mechanism_codesign'><link "
                    "name='ground'/>" +
                        content + "</robot>"},
                   {}, {"near.yaml", "duration: 1.0\n"}, {}, TrajectoryLoader(), FileLoader());
  Simulation simulation(problem, problem.parameters(), {});
  EXPECT_TRUE(simulation.start().ok());
  Frame frame;
  simulation.sample(0.0, &frame);
  return find_near_links(problem, problem.parameters(), simulation.names().links, frame);
}

TEST(NearLinks, AreThoseThatNothingConnects) {
  const std::string arms = link("a", "0") + link("b", "0.11") + link("c", "0.5");
  const std::vector<NearLinks> near = near_links(arms);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].first + near[0].second, "ab");
  EXPECT_NEAR(near[0].distance, 0.01, 1e-15);
  EXPECT_TRUE(near_links(arms +
                         "<codesign:contact name='touch' stiffness='1'><predecessor link='a' "
                         "shape='plane'/><successor link='b' shape='sphere' radius='0.01'/>"
                         "</codesign:contact>")
                  .empty());
  EXPECT_TRUE(near_links(link("a", "0") +
                         "<link name='b'><inertial><mass value='1'/><inertia ixx='1' ixy='0' "
                         "ixz='0' iyy='1' iyz='0' izz='1'/></inertial><collision><geometry><box "
                         "size='0.1 0.1 0.1'/></geometry></collision></link><joint name='hinge' "
                         "type='continuous'><parent link='a'/><child link='b'/></joint>")
                  .empty())
      << "a joint connects them";
}

TEST(NearLinks, OfTwoBodiesTheNearestPairIsTold) {
  const auto plate = [](const std::string& name, const std::string& on, const std::string& z) {
    return "<link name='" + name +
           "'><collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision></link><joint "
           "name='weld_" +
           name + "' type='fixed'><parent link='" + on + "'/><child link='" + name +
           "'/><origin xyz='0 0 " + z + "'/></joint>";
  };
  const std::vector<NearLinks> near =
      near_links(link("a", "0") + link("b", "0.109") + plate("c", "b", "-0.007"));
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].first + near[0].second, "ac");
  EXPECT_NEAR(near[0].distance, 0.002, 1e-15);
}

}  // namespace
}  // namespace codesign
