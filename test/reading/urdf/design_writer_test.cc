// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/design_writer.h"

#include <limits>

#include "reading/urdf/annotated_urdf.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText jointed() { return pendulum(R"(<origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/>)"); }

TEST(DesignWriter, ChangesDefaultsBoundsAndTwins) {
  XmlDocument document = load_annotated_urdf(jointed(), {});
  write_design(read_robot(document), {0.5}, &document);
  const RobotDescription robot = read_robot(document);
  EXPECT_EQ(robot.parameters[0].value, 0.5);
  EXPECT_EQ(robot.parameters[0].upper, 0.5) << "a bound that is exceeded is moved";
  EXPECT_EQ(robot.parameters[0].lower, 0.1);
  EXPECT_EQ(robot.joints[0].origin.xyz[2].nominal(), 0.5);
}

TEST(DesignWriter, RefusesWhatIsNotFinite) {
  XmlDocument document = load_annotated_urdf(jointed(), {});
  EXPECT_THROW(write_design(read_robot(document), {std::numeric_limits<double>::quiet_NaN()}, &document), InputError);
}

}  // namespace
}  // namespace codesign
