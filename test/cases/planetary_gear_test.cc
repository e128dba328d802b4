// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The planetary gear of doc/actuators.md.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kTeeth = 4.0, kSunTorque = 0.5;

std::string block(const std::string& section, const std::string& language) {
  const std::size_t first = section.find("```" + language + "\n") + language.size() + 4;
  return section.substr(first, section.find("```", first) - first);
}

Problem page_problem(double efficiency, double backdrive) {
  const std::string page = read_source(source_dir() + "/doc/actuators.md").text;
  const std::string section = page.substr(page.find("## A planetary gear"));
  std::string urdf = block(section, "xml");
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(urdf.find(from), std::string::npos) << from;
    urdf.replace(urdf.find(from), from.size(), to);
  };
  replace(R"(efficiency="0.97" backdrive_efficiency="0.95")",
          "efficiency=\"" + std::to_string(efficiency) + "\" backdrive_efficiency=\"" +
              std::to_string(backdrive) + "\"");
  return load_problem({"planetary.urdf", urdf}, {}, {"planetary.yaml", block(section, "yaml")});
}

/// Power at the carrier over power at the sun while the ring stands still.
double ratio_of_powers(const Problem& problem, double sun_torque) {
  Simulation simulation(problem, problem.parameters({{"sun_torque", sun_torque}}),
                        {"carrier_joint/effort", "carrier_joint/velocity", "mesh/motor_speed"});
  Frame frame;
  EXPECT_TRUE(simulation.start().ok());
  EXPECT_TRUE(simulation.advance(0.5).ok());
  simulation.sample(0.5, &frame);
  const std::vector<double>& s = frame.signals;
  const double sun_speed = s[1] + s[2];  // the rotor turns relative to the carrier
  EXPECT_NEAR(sun_speed, (1.0 + kTeeth) * s[1], 1e-9);
  return -s[0] * s[1] / (sun_torque * sun_speed);
}

// Only what rolls, the part z_r/(z_s + z_r) of the power, is subject to the loss.
TEST(PlanetaryGear, HasTheEfficiencyOfItsTrainInBothDirections) {
  for (const auto& [efficiency, backdrive] :
       {std::pair(0.97, 0.95), std::pair(0.6, 0.4), std::pair(1.0, 1.0)}) {
    const Problem problem = page_problem(efficiency, backdrive);
    EXPECT_NEAR(ratio_of_powers(problem, kSunTorque), (1.0 + kTeeth * efficiency) / (1.0 + kTeeth),
                1e-6);
    EXPECT_NEAR(1.0 / ratio_of_powers(problem, -kSunTorque),
                (1.0 + kTeeth) / (1.0 + kTeeth / backdrive), 1e-6);
  }
}

}  // namespace
}  // namespace codesign
