// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(AnnotationSchema, OthersArePassedOver) {
  EXPECT_NO_THROW(read_urdf(
      robot_text("<link name=\"a\" my:note=\"x\"><my:thing a=\"1\"/></link><gazebo "
                 "reference=\"a\"><kp>1</kp></gazebo>"
                 "<transmission name=\"t\"><type>any</type><joint "
                 "name=\"j\"><hardwareInterface>x</hardwareInterface></joint></transmission>"
                 "<my:tag xmlns:my=\"urn:my\"/><unknown_plain/>")));
  EXPECT_NO_THROW(read_urdf({"plain.urdf", "<robot name=\"x\"><link name=\"a\"/></robot>"}));
}

}  // namespace
}  // namespace codesign
