// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/description.h"

#include <gtest/gtest.h>

#include "reading/urdf/pictures.h"
#include "reading/urdf/urdf_reader.h"
#include "ros/pendulum.h"

namespace codesign {
namespace {

std::string effective(const Problem& problem) { return write_tuned_urdf(problem.urdf(), problem.overlays(), problem.parameters()); }

TEST(Description, TheModelDescribesItselfAtItsOwnValues) {
  const Problem problem = pendulum();
  EXPECT_TRUE(describes(kPendulumUrdf, problem, effective(problem)));
  EXPECT_TRUE(describes("\n" + effective(problem) + "\n", problem, effective(problem)));
  EXPECT_FALSE(describes("<robot name='pendulum'/>", problem, effective(problem)));
}

TEST(Description, SticksForLinksWithoutVisualDoNotMakeItAnotherMechanism) {
  const Problem problem = pendulum();
  const std::string drawn = with_sticks(effective(problem));
  EXPECT_NE(drawn, effective(problem));
  EXPECT_TRUE(describes(drawn, problem, effective(problem)));
}

TEST(Description, AValueMakesItAnotherMechanism) {
  const Problem problem = with_settings(pendulum(), {{"length", 0.6}});
  EXPECT_FALSE(describes(kPendulumUrdf, problem, effective(problem)));
  EXPECT_TRUE(describes(effective(problem), problem, effective(problem)));
}

TEST(Description, AnOverlayMakesItAnotherMechanism) {
  const SourceText overlay{"overlay.urdf", R"(<robot name="pendulum"><joint name="hinge"><dynamics damping="0.1"/></joint></robot>)"};
  const Problem problem = load_problem({"pendulum.urdf", kPendulumUrdf}, {overlay}, {"pendulum.yaml", kPendulumStudy});
  EXPECT_FALSE(describes(kPendulumUrdf, problem, effective(problem)));
  EXPECT_NE(effective(problem).find("damping=\"0.1\""), std::string::npos);
}

}  // namespace
}  // namespace codesign
