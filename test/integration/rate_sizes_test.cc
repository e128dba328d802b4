// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/rate_sizes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "assembly/make_system.h"
#include "integration/mechanisms.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "text/number_text.h"

namespace codesign {
namespace {

std::string spinning(const std::string& type, const std::string& inertia = "0.01") {
  return robot("<link name='b'><inertial><mass value='1'/><inertia ixx='" + inertia +
               "' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial></link><joint "
               "name='j' type='" +
               type + "'><parent link='ground'/><child link='b'/><axis xyz='1 0 0'/></joint>");
}

struct Spin {
  std::int64_t steps = 0;
  double turn_error = 0.0;  ///< of the orientation at the end [rad]
};

/// Spins a body through 100 rad about an axis.
Spin spin(const std::string& urdf, const std::string& start, const Eigen::Vector3d& axis,
          const std::string& solver) {
  const RobotDescription description = read_urdf({"test.urdf", urdf});
  const Study study = read_study({"test.yaml",
                                  "duration: 0.1\ngravity: [0, 0, 0]\ninitial_state: "
                                  "{j: " +
                                      start + "}\nsolver: {" + solver + "}\n"},
                                 description);
  Simulation simulation = simulation_of(make_system(description, study), {});
  Frame last;
  const Status status = simulate(&simulation, 0.1, 2, [&last](const Frame& frame) {
    last = frame;
    return true;
  });
  EXPECT_TRUE(status.ok()) << solver << status.cause;
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(100.0, axis.normalized()));
  return {simulation.statistics().steps, expected.angularDistance(last.links.back().orientation)};
}

TEST(RateSizes, AFastSpinTakesFewerStepsInAnyCoordinatesAndAxes) {
  for (const auto& [solver, most] :
       std::vector<std::pair<std::string, int>>{{"coordinates: joint, method: dopri5", 360},
                                                {"coordinates: absolute, method: dopri5", 360},
                                                {"method: rodas5p", 900},
                                                {"coordinates: absolute, method: rodas5p", 900}}) {
    const Spin about_x = spin(spinning("floating"), "{angular_velocity: [1000, 0, 0]}",
                              Eigen::Vector3d::UnitX(), solver),
               about_any = spin(spinning("floating"), "{angular_velocity: [600, -640, 480]}",
                                Eigen::Vector3d(600, -640, 480), solver),
               hinged = spin(spinning("continuous"), "{velocity: 1000}", Eigen::Vector3d::UnitX(),
                             solver);
    for (const Spin* one : {&about_x, &about_any, &hinged}) {
      EXPECT_LT(one->steps, most) << solver;
      EXPECT_LT(one->turn_error, 2e-2) << solver;
    }
  }
}

TEST(RateSizes, ASizeIsThatOfTheWholeRotation) {
  const RobotDescription description = read_urdf({"test.urdf", spinning("floating")});
  const CompiledSystem system(description, read_study({"test.yaml", "duration: 1\n"}, description));
  const RateSizes sizes(system.layout());
  Eigen::VectorXd v(7);
  v << 3.0, -4.0, 0.0, 1.0, 2.0, -2.0, 0.0;
  const double expected[] = {3.0, 4.0, 0.0, 3.0, 3.0, 3.0, 3.0};
  for (int k = 0; k < 7; ++k) EXPECT_DOUBLE_EQ(sizes.of(v, k), expected[k]) << k;
}

}  // namespace
}  // namespace codesign
