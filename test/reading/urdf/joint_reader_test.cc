// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(ReadContext, FindsLinksAndEnds) {
  const XmlDocument document(
      {"a.urdf", "<robot><predecessor link=\"b\"/>\n<successor link=\"a\"/></robot>"});
  const XmlElement robot(document.robot(), &document);
  const ReadContext context{{"a", "b"}, {}};
  EXPECT_EQ(context.link(robot.only("successor"), "link"), 0);
  EXPECT_EQ(context.ends(robot), (std::pair<int, int>{1, 0}));
  const ReadContext other{{"b", "c"}, {}};
  EXPECT_THROW(other.link(robot.only("successor"), "link"), InputError);
}

TEST(ReadContext, EndsMustDiffer) {
  const XmlDocument document(
      {"a.urdf", "<robot><predecessor link=\"a\"/>\n<successor link=\"a\"/></robot>"});
  const ReadContext context{{"a", "b"}, {}};
  try {
    context.ends(XmlElement(document.robot(), &document));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.line, 2);
  }
}

JointDescription hinge(const std::string& content) {
  return read_urdf(hinged_arm(content)).joints.at(0);
}

SourceText typed(const std::string& type, const std::string& content = "") {
  return robot_text(kGround + link_with("arm") + "\n" +
                    joint_with("j", type, "ground", "arm", content));
}

SourceText read_limits(const std::string& type, const std::string& numbers) {
  return typed(type, "<limit " + numbers + "/>");
}

TEST(JointReader, DefaultsAreThoseOfUrdf) {
  const JointDescription joint = hinge("");
  EXPECT_EQ(joint.name, "hinge");
  EXPECT_EQ(joint.type, JointType::kContinuous);
  EXPECT_FALSE(joint.is_loop);
  EXPECT_EQ(joint.parent, 0);
  EXPECT_EQ(joint.child, 1);
  EXPECT_EQ(joint.axis[0].nominal(), 1.0);
  EXPECT_EQ(joint.origin.xyz[2].nominal(), 0.0);
  EXPECT_EQ(joint.damping.nominal(), 0.0);
  EXPECT_FALSE(joint.friction || joint.limit || joint.mimic || joint.spring);
  EXPECT_EQ(joint.where.line, 2);
}

TEST(JointReader, ReadsAllTypes) {
  const char* limit = R"(<limit lower="-1" upper="2" effort="3" velocity="4"/>)";
  EXPECT_EQ(read_urdf(typed("fixed")).joints[0].type, JointType::kFixed);
  EXPECT_EQ(read_urdf(typed("revolute", limit)).joints[0].type, JointType::kRevolute);
  EXPECT_EQ(read_urdf(typed("prismatic", limit)).joints[0].type, JointType::kPrismatic);
  EXPECT_EQ(read_urdf(typed("planar")).joints[0].type, JointType::kPlanar);
  EXPECT_EQ(read_urdf(typed("floating")).joints[0].type, JointType::kFloating);
  expect_error(typed("revolut"),
               {"test.urdf:3: <joint name=\"j\">: unknown joint type, did you mean \"revolute\"?"});
}

TEST(JointReader, TypesThatUrdfLacks) {
  EXPECT_EQ(read_urdf(typed("floating\" codesign:type=\"spherical")).joints[0].type,
            JointType::kSpherical);
  EXPECT_EQ(read_urdf(typed("floating\" codesign:type=\"cylindrical")).joints[0].type,
            JointType::kCylindrical);
  expect_error(typed("spherical"), {"test.urdf:3", "other readers of URDF refuse",
                                    "type=\"floating\" codesign:type=\"spherical\""});
  expect_error(typed("ball"), {"test.urdf:3", "codesign:type=\"spherical\""});
  expect_error(typed("codesign:cylindrical"), {"codesign:type=\"cylindrical\""});
  expect_error(typed("screw"), {"test.urdf:3", "<mimic>"});
}

TEST(JointReader, AxisAndDynamicsMayHaveTwins) {
  const JointDescription joint = hinge(
      R"(<axis xyz="0 0.2 1" codesign:xyz="0 ${length} 1"/><dynamics damping="0.1" codesign:damping="${length/2}" friction="0.3"/>)");
  const std::vector<double> at = {0.4};
  EXPECT_DOUBLE_EQ(joint.axis[1].at(at), 0.4);
  EXPECT_DOUBLE_EQ(joint.damping.at(at), 0.2);
  EXPECT_DOUBLE_EQ(joint.dry_friction.at(at), 0.3);
  expect_error(hinged_arm("<axis xyz=\"0 0 0\"/>"), {"<axis>: the axis is zero"});
  expect_error(hinged_arm("<axis/>"), {"the attribute xyz is missing", "(allowed: xyz=\"...\")"});
  expect_error(hinged_arm("<dynamics/>"), {"neither damping nor friction"});
  expect_warning(hinged_arm("<dynamics damping=\"-1\"/>"), "negative_value",
                 {"test.urdf:2:", "damping is negative and is taken as zero"});
  EXPECT_EQ(hinge("<dynamics damping=\"-1\"/>").damping.nominal(), 0.0);
  expect_warning(hinged_arm("<origin/><origin/>"), "repeated_element", {"a second <origin>"});
}

TEST(JointReader, Limits) {
  const JointDescription joint = hinge(R"(<limit lower="-1" upper="2" effort="3" velocity="4"/>)");
  EXPECT_EQ(joint.limit->lower.nominal(), -1.0);
  EXPECT_EQ(joint.limit->upper.nominal(), 2.0);
  EXPECT_EQ(joint.limit->effort.nominal(), 3.0);
  EXPECT_EQ(joint.limit->velocity.nominal(), 4.0);
  expect_error(typed("prismatic"),
               {"needs a <limit>", "(value: prismatic, allowed: <limit lower="});
  const SourceText reversed =
      read_limits("revolute", R"(lower="2" upper="1" effort="1" velocity="1")");
  expect_warning(
      reversed, "limits_reversed",
      {"test.urdf:", "the lower limit is above the upper limit (1): the joint has no stops"});
  EXPECT_FALSE(has_stops(read_urdf(reversed).joints[0]));
  expect_warning(hinged_arm(R"(<limit lower="-1" upper="1" effort="1" velocity="1"/>)"),
                 "limit_ignored", {"turns without end", "-1 ... 1"});
  expect_error(hinged_arm(R"(<limit velocity="1"/>)"), {"the attribute effort is missing"});
  expect_warning(
      hinged_arm(R"(<limit effort="-1" velocity="1"/>)"), "negative_value",
      {"<limit>: effort is negative and means, as in SDF, that there is no limit", "(value: -1)"});
}

TEST(JointReader, LimitsThatDependOnTheDesign) {
  const JointDescription joint = hinge(
      R"(<limit lower="-0.2" codesign:lower="${-length}" effort="2" codesign:effort="${10*length}" velocity="4"/>)");
  EXPECT_EQ(joint.limit->lower.at(std::vector<double>{0.3}), -0.3);
  EXPECT_EQ(joint.limit->effort.at(std::vector<double>{0.3}), 3.0);
}

TEST(JointReader, ZeroLimitsBoundNothing) {
  const auto limit = [](const std::string& numbers) {
    return *read_urdf(typed("revolute", "<limit " + numbers + "/>")).joints[0].limit;
  };
  const LimitDescription unknown = limit(R"(lower="0" upper="0" effort="0" velocity="0")");
  EXPECT_FALSE(unknown.bounds_position() || unknown.bounds_effort() || unknown.bounds_velocity());
  EXPECT_FALSE(limit(R"(effort="1" velocity="2")").bounds_position());
  const LimitDescription known = limit(R"(upper="1" effort="1" velocity="2")");
  EXPECT_TRUE(known.bounds_position() && known.bounds_effort() && known.bounds_velocity());
  EXPECT_TRUE(has_stops(
      read_urdf(typed("revolute", R"(<limit upper="1" effort="1" velocity="2"/>)")).joints[0]));
  EXPECT_FALSE(has_stops(
      read_urdf(typed("continuous", R"(<limit upper="1" effort="1" velocity="2"/>)")).joints[0]));
}

TEST(JointReader, Springs) {
  const JointDescription joint = hinge(
      R"(<codesign:torsion_spring stiffness="5" damping="1" free_position="0.2" codesign:free_position="${length}"/>)");
  EXPECT_EQ(joint.spring->stiffness.nominal(), 5.0);
  EXPECT_EQ(joint.spring->damping.nominal(), 1.0);
  EXPECT_EQ(joint.spring->free_position.at(std::vector<double>{0.3}), 0.3);
  expect_error(hinged_arm("<codesign:torsion_spring damping=\"1\"/>"),
               {"the attribute stiffness is missing"});
  expect_error(typed("floating", "<codesign:torsion_spring stiffness=\"1\"/>"),
               {"no single coordinate for a spring"});
}

TEST(JointReader, Actuators) {
  const JointDescription joint = hinge(
      R"(<codesign:actuator gear_ratio="-10" codesign:gear_ratio="${-50*length}" rotor_inertia="2e-5" codesign:rotor_inertia="${length/1e4}"/>)");
  EXPECT_EQ(joint.actuator->gear_ratio.at(std::vector<double>{0.3}), -15.0);
  EXPECT_DOUBLE_EQ(joint.actuator->rotor_inertia.at(std::vector<double>{0.3}), 3e-5);
  EXPECT_EQ(hinge("<codesign:actuator rotor_inertia=\"1e-5\"/>").actuator->gear_ratio.nominal(),
            1.0);
  expect_error(hinged_arm("<codesign:actuator gear_ratio=\"3\"/>"),
               {"the attribute rotor_inertia is missing"});
  expect_error(hinged_arm("<codesign:actuator gear_ratio=\"0\" rotor_inertia=\"1\"/>"),
               {"the gear ratio is zero"});
  expect_error(hinged_arm("<codesign:actuator rotor_inertia=\"-1\"/>"),
               {"rotor_inertia is negative"});
  expect_error(hinged_arm("<codesign:actuator rotor_inertia=\"1\" gear_ration=\"2\"/>"),
               {"did you mean \"gear_ratio\""});
  expect_error(typed("floating", "<codesign:actuator rotor_inertia=\"1\"/>"),
               {"no single coordinate for a rotor"});
}

TEST(JointReader, Mimics) {
  const std::string second =
      link_with("tip") + joint_with("wrist", "continuous", "arm", "tip",
                                    R"(<mimic joint="hinge" multiplier="-2" offset="1"/>)");
  const MimicDescription mimic = *read_urdf(hinged_arm("", second)).joints[1].mimic;
  EXPECT_EQ(mimic.joint, "hinge");
  EXPECT_EQ(mimic.multiplier.nominal(), -2.0);
  EXPECT_EQ(mimic.offset.nominal(), 1.0);
  expect_warning(typed("planar", "<mimic joint=\"x\"/>"), "mimic_ignored",
                 {"a joint of this type cannot mimic", "planar"});
}

TEST(JointReader, WhatReadersOfURDFPassOverIsNotJudged) {
  const std::string nonsense =
      "<axis xyz=\"0 0 0\"/><limit lower=\"3\" upper=\"1\" effort=\"1\" velocity=\"1\"/><dynamics "
      "damping=\"-1\"/>";
  expect_no_warning(typed("fixed", nonsense));
  expect_no_warning(typed("floating", "<axis xyz=\"0 0 0\"/><limit effort=\"1\" velocity=\"1\"/>"));
  expect_warning(typed("fixed", "<mimic joint=\"other\"/>"), "mimic_ignored",
                 {"cannot mimic", "fixed"});
  const SourceText damped = typed("planar", "<dynamics damping=\"0.1\"/>");
  expect_warning(damped, "dynamics_ignored", {"it moves freely"});
  EXPECT_EQ(read_urdf(damped).joints[0].damping.nominal(), 0.0);
}

/// A robot with the loop on line 3.
SourceText loop_text(
    const std::string& type, const std::string& content = "",
    const std::string& ends = "<predecessor link=\"ground\"/><successor link=\"arm\"/>") {
  return hinged_arm("", "<loop name=\"l\" type=\"" + type + "\">" + ends + content + "</loop>");
}

JointDescription loop(const std::string& type, const std::string& content = "") {
  return read_urdf(loop_text(type, content)).joints.at(1);
}

TEST(LoopReader, ReadsEndsWithTheirOrigins) {
  const JointDescription l =
      read_urdf(
          loop_text(
              "revolute", "<axis xyz=\"0 0 1\"/>",
              R"(<predecessor link="ground"><origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/></predecessor>
                 <successor link="arm"><origin rpy="0 0 1"/></successor>)"))
          .joints.at(1);
  EXPECT_TRUE(l.is_loop);
  EXPECT_EQ(l.parent, 0);
  EXPECT_EQ(l.child, 1);
  EXPECT_EQ(l.origin.xyz[2].at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(l.child_origin.rpy[2].nominal(), 1.0);
  EXPECT_EQ(l.axis[2].nominal(), 1.0);
  EXPECT_EQ(l.where.line, 3);
}

TEST(LoopReader, ReadsAllTypes) {
  EXPECT_EQ(loop("fixed").type, JointType::kFixed);
  EXPECT_EQ(loop("revolute").type, JointType::kRevolute);
  EXPECT_EQ(loop("continuous").type, JointType::kContinuous);
  EXPECT_EQ(loop("prismatic").type, JointType::kPrismatic);
  EXPECT_EQ(loop("planar").type, JointType::kPlanar);
  EXPECT_EQ(loop("codesign:spherical").type, JointType::kSpherical);
  EXPECT_EQ(loop("codesign:cylindrical").type, JointType::kCylindrical);
  EXPECT_EQ(loop("revolute").axis[0].nominal(), 1.0) << "URDF's default axis";
  expect_error(loop_text("spherical"),
               {"test.urdf:3: <loop name=\"l\">: unknown loop type", "codesign:spherical"});
  expect_error(loop_text("codesign:sperical"), {"did you mean \"codesign:spherical\"?"});
  expect_error(loop_text("floating"), {"unknown loop type"});
}

TEST(LoopReader, SaysWhatActsOutOfThePlane) {
  const auto text = [](const std::string& type, const std::string& value) {
    SourceText loop = loop_text(type, "");
    loop.text.replace(loop.text.find("<loop "), 6,
                      "<loop codesign:out_of_plane=\"" + value + "\" ");
    return loop;
  };
  EXPECT_FALSE(loop("revolute").in_plane);
  EXPECT_FALSE(read_urdf(text("codesign:spherical", "shared")).joints.at(1).in_plane);
  for (const char* type : {"revolute", "continuous", "prismatic", "fixed"}) {
    EXPECT_FALSE(read_urdf(text(type, "shared")).joints.at(1).in_plane);
    const JointDescription held = read_urdf(text(type, "zero")).joints.at(1);
    EXPECT_TRUE(held.in_plane);
    EXPECT_LT(kind_of(held)->rows, 4);
  }
  expect_error(text("revolute", "none"),
               {"test.urdf:3: <loop name=\"l\">", "out of the plane", "none", "zero or shared"});
  expect_error(text("codesign:universal", "zero"),
               {"a loop of type codesign:universal cannot be held in a plane only",
                "fixed, revolute, continuous, prismatic"});
  expect_error(hinged_arm("", "<joint name=\"a\" codesign:out_of_plane=\"zero\"/>"),
               {"codesign:out_of_plane"});
}

TEST(LoopReader, OverlaysSayWhatActsOutOfThePlane) {
  const SourceText model = loop_text("revolute", "");
  EXPECT_TRUE(read_urdf(model, {overlay_text("<loop name=\"l\" codesign:out_of_plane=\"zero\"/>")})
                  .joints.at(1)
                  .in_plane);
}

TEST(LoopReader, UniversalHasASecondAxis) {
  const JointDescription l =
      loop("codesign:universal", "<axis xyz=\"0 0 1\"/><codesign:second_axis xyz=\"1 0 0\"/>");
  EXPECT_EQ(l.axis[2].nominal(), 1.0);
  EXPECT_EQ(l.second_axis[0].nominal(), 1.0);
  EXPECT_EQ(loop("codesign:universal").second_axis[1].nominal(), 1.0);
  expect_error(loop_text("revolute", "<codesign:second_axis xyz=\"1 0 0\"/>"),
               {"only a loop of type codesign:universal"});
}

TEST(LoopReader, DistanceHasALength) {
  const JointDescription l =
      loop("codesign:distance", R"(<codesign:length value="0.4" codesign:value="${2*length}"/>)");
  EXPECT_EQ(l.type, JointType::kDistance);
  EXPECT_DOUBLE_EQ(l.distance.at(std::vector<double>{0.3}), 0.6);
  expect_error(loop_text("codesign:distance"), {"the element <codesign:length> is missing"});
  expect_error(loop_text("codesign:distance", "<codesign:length value=\"0\"/>"),
               {"value is not positive"});
  expect_error(loop_text("planar", "<codesign:length value=\"1\"/>"),
               {"only a loop of type codesign:distance"});
}

TEST(LoopReader, TakesFrictionDampingAndSprings) {
  const JointDescription l = loop("revolute",
                                  R"(<dynamics damping="1"/><codesign:torsion_spring stiffness="2"/>
      <codesign:friction mu_static="0.4" mu_dynamic="0.3" joint_length="0.1" pin_radius="0.1"/>)");
  EXPECT_EQ(l.damping.nominal(), 1.0);
  EXPECT_EQ(l.spring->stiffness.nominal(), 2.0);
  EXPECT_TRUE(l.friction);
}

}  // namespace
}  // namespace codesign
