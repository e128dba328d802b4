// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/drive_lines.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

JointDescription limited_joint(JointType type) {
  JointDescription joint;
  joint.name = "hinge";
  joint.type = type;
  joint.limit.emplace();
  joint.limit->effort = Quantity(40.0);
  joint.limit->velocity = Quantity(4.0);
  return joint;
}

bool says(const OverlayLines& lines, const std::string& part) {
  return lines.text().find(part) != std::string::npos;
}

TEST(DriveLines, AnArmatureIsAnElementOnceNothingIsMissing) {
  const JointDescription joint = limited_joint(JointType::kRevolute);
  OverlayLines known, waiting;
  write_armature({joint, 50.0, ""}, 0.5, &known);
  EXPECT_TRUE(says(known,
                   "\n  <joint name=\"hinge\"><codesign:actuator gear_ratio=\"50\" "
                   "rotor_inertia=\"2e-04\"/></joint>"))
      << known.text();
  EXPECT_FALSE(says(known, "usual"));
  write_armature({joint, 0.0, "once it has a mass"}, 0.5, &waiting);
  EXPECT_TRUE(says(waiting, "; once it has a mass. -->\n  <!-- <joint")) << waiting.text();
  EXPECT_TRUE(says(waiting, "rotor_inertia=\"5e-05\"")) << waiting.text();
}

TEST(DriveLines, UsualNumbersFollowTheLimits) {
  OverlayLines hinge, slide, bare;
  write_gear({limited_joint(JointType::kRevolute), 0.0, ""}, &hinge);
  write_friction(limited_joint(JointType::kRevolute), &hinge);
  EXPECT_TRUE(says(hinge, "gear_ratio=\"100\" rotor_inertia=\"4e-06\"")) << hinge.text();
  EXPECT_TRUE(says(hinge, "damping=\"0.3\" friction=\"1.2\"")) << hinge.text();
  write_gear({limited_joint(JointType::kPrismatic), 0.0, ""}, &slide);
  EXPECT_TRUE(says(slide, "gear_ratio=\"628\" rotor_inertia=\"1e-05\"")) << slide.text();
  JointDescription unlimited = limited_joint(JointType::kContinuous);
  unlimited.limit.reset();
  write_friction(unlimited, &bare);
  EXPECT_TRUE(says(bare, "without a limit, for 10 N m")) << bare.text();
  EXPECT_TRUE(says(bare, "damping=\"0.3\" friction=\"0.3\"")) << bare.text();
}

}  // namespace
}  // namespace codesign
