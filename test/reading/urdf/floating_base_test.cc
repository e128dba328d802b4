// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/floating_base.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// A base of 2 kg with an arm on it.
SourceText walker(const std::string& base = kInertial, const std::string& more = "") {
  return robot_text(link_with("base & <link>", base) + link_with("arm") +
                    joint_with("hinge", "continuous", "base & <link>", "arm") + more);
}

/// The XML of a name.
SourceText as_xml(SourceText text) {
  for (std::size_t at = 0; (at = text.text.find("base & <link>", at)) != std::string::npos; ++at)
    text.text.replace(at, 13, "base &amp; &lt;link>");
  return text;
}

TEST(FloatingBase, IsAnOverlayWithAFloatingJointAboveTheRootLink) {
  const SourceText model = as_xml(walker());
  const std::vector<SourceText> overlays = with_floating_base(read_urdf(model), {});
  ASSERT_EQ(overlays.size(), 1U);
  const RobotDescription robot = read_urdf(model, overlays);
  ASSERT_EQ(robot.joints.size(), 2U);
  const JointDescription& free = robot.joints[1];
  EXPECT_EQ(free.name, kFloatingBaseJoint);
  EXPECT_EQ(free.type, JointType::kFloating);
  EXPECT_EQ(free.parent, robot.root);
  EXPECT_EQ(robot.links[static_cast<std::size_t>(robot.root)].name, "world");
  EXPECT_EQ(robot.links[static_cast<std::size_t>(free.child)].name, "base & <link>");
  EXPECT_EQ(with_floating_base(robot, overlays).size(), 1U) << "once";
}

TEST(FloatingBase, NeedsMassAndFreeNames) {
  const auto refusal = [](const SourceText& model) {
    try {
      with_floating_base(read_urdf(model), {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    ADD_FAILURE() << "accepted";
    return std::string();
  };
  EXPECT_NE(refusal(as_xml(walker(""))).find("have no mass"), std::string::npos);
  EXPECT_NE(refusal(as_xml(walker(kInertial, link_with("world", "") +
                                                 joint_with("mount", "fixed", "arm", "world"))))
                .find("of the name"),
            std::string::npos);
  EXPECT_NE(
      refusal(as_xml(walker(kInertial, link_with("tip") + joint_with(kFloatingBaseJoint,
                                                                     "continuous", "arm", "tip"))))
          .find("of the name"),
      std::string::npos);
}

// Many files have a first link without mass, to which the one with the mass is fixed.
TEST(FloatingBase, TheMassMayBeOfALinkThatIsFixedToTheRoot) {
  const SourceText model =
      robot_text(link_with("base", "") + link_with("trunk") + link_with("arm") +
                 joint_with("mount", "fixed", "base", "trunk") +
                 joint_with("hinge", "continuous", "trunk", "arm"));
  const std::vector<SourceText> overlays = with_floating_base(read_urdf(model), {});
  EXPECT_EQ(read_urdf(model, overlays).joints.back().type, JointType::kFloating);
}

}  // namespace
}  // namespace codesign
