// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The numbers of doc/actuators.md.
#include <gtest/gtest.h>

#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::string block(const std::string& page, const std::string& language) {
  const std::size_t first = page.find("```" + language + "\n") + language.size() + 4;
  return page.substr(first, page.find("```", first) - first);
}

TEST(ActuatorsPage, TheArmDoesWhatThePageSays) {
  const std::string page = read_source(source_dir() + "/doc/actuators.md").text;
  const Problem problem =
      load_problem({"arm.urdf", block(page, "xml")}, {}, {"arm.yaml", block(page, "yaml")});
  Simulation simulation = simulation_of(system_of(problem), problem.parameters());
  Frame frame;
  ASSERT_TRUE(simulation.start().ok());
  simulation.sample(0.0, &frame);
  EXPECT_NEAR(frame.joints.at(0).acceleration, 8.333, 1e-3);
  ASSERT_TRUE(simulation.advance(4.0).ok());
  simulation.sample(4.0, &frame);
  EXPECT_NEAR(frame.joints.at(0).velocity, 3.134, 1e-3);
  EXPECT_NEAR(frame.frictions.at(0).friction, -1.997, 1e-3);
}

}  // namespace
}  // namespace codesign
