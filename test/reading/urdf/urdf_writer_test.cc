// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_reader.h"

#include <cmath>
#include <limits>

#include "mechanism/mass_properties.h"
#include "paths.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText jointed() {
  return hinged_arm(R"(<origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/>)");
}

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
  EXPECT_THROW(
      write_design(read_robot(document), {std::numeric_limits<double>::quiet_NaN()}, &document),
      InputError);
}

SourceText slider_crank() { return read_source(source_dir() + "/urdf/slider_crank.urdf"); }

SourceText tuned(const SourceText& urdf, const std::vector<double>& at,
                 const std::vector<SourceText>& overlays = {}) {
  return {"tuned.urdf", write_tuned_urdf(urdf, overlays, at)};
}

TEST(UrdfWriter, ReadsBackAsTheSameDesignAtItsNewDefaults) {
  const std::vector<double> at = {0.0612345678901234, 0.22358, 0.04, 0.02, 5.0};
  const RobotDescription before = read_urdf(slider_crank()),
                         after = read_urdf(tuned(slider_crank(), at));
  ASSERT_EQ(after.parameters.size(), before.parameters.size());
  for (std::size_t k = 0; k < after.parameters.size(); ++k) {
    EXPECT_EQ(after.parameters[k].value, at[k]);
    EXPECT_EQ(after.parameters[k].lower, before.parameters[k].lower);
    EXPECT_EQ(after.parameters[k].upper, before.parameters[k].upper);
  }
  const std::vector<double> elsewhere = {0.09, 0.35, 0.05, 0.03};
  for (std::size_t k = 0; k < after.links.size(); ++k) {
    if (!before.links[k].inertial) continue;
    const auto a = mass_properties(*before.links[k].inertial, elsewhere),
               b = mass_properties(*after.links[k].inertial, elsewhere);
    EXPECT_DOUBLE_EQ(a.mass, b.mass);
    EXPECT_EQ((a.inertia - b.inertia).norm(), 0.0);
  }
  EXPECT_EQ(after.joints[1].origin.xyz[1].nominal(), at[0]);
  EXPECT_EQ(after.joints[4].friction->joint_length.nominal(), 0.04);
}

TEST(UrdfWriter, WritesWhatReadersOfPlainUrdfSee) {
  const std::string text = tuned(slider_crank(), {0.06, 0.2, 0.04, 0.02}).text;
  for (const char* part : {"size=\"0.04 0.02 0.02\"", "<mass value=\"1.024", "xyz=\"0.1 0 0\"",
                           "SPDX-License-Identifier", "codesign:size=\"${slider_length}"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(UrdfWriter, ItsDefaultsChangeNothing) {
  const SourceText once = tuned(slider_crank(), {0.08, 0.3, 0.05, 0.025});
  EXPECT_EQ(tuned(once, {0.08, 0.3, 0.05, 0.025}).text, once.text);
}

TEST(UrdfWriter, InertialsFromShapesFollow) {
  const SourceText urdf =
      robot_text(link_with("a", R"(<inertial codesign:density="1000"><mass value="2"/>
      <origin xyz="0 0 0.1" rpy="0 0 1.5707963267948966"/>
      <inertia ixx="0.0083333333333333332" ixy="0" ixz="0" iyy="0.0083333333333333332" iyz="0" izz="0.0033333333333333335"/></inertial>
      <visual><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}"/><geometry><box size="0.1 0.1 0.2" codesign:size="0.1 0.1 ${length}"/></geometry></visual>)"));
  const SourceText written = tuned(urdf, {0.3});
  EXPECT_NE(written.text.find("<mass value=\"3"), std::string::npos) << written.text;
  const RobotDescription robot = read_urdf(written);
  EXPECT_DOUBLE_EQ(mass_properties(*robot.links[0].inertial, std::vector<double>{0.3}).centre[2],
                   0.15);
}

TEST(UrdfWriter, OverlaysAreMergedIn) {
  const SourceText vendor = {
      "vendor.urdf",
      std::string("<robot name=\"vendor\">") + kGround + link_with("arm") +
          joint_with("hinge", "continuous", "ground", "arm", "<origin xyz=\"0 0 0.2\"/>") +
          "</robot>"};
  const SourceText overlay = {
      "notes.urdf",
      "<robot xmlns:codesign=\"urn:x\"><codesign:parameter name=\"height\" value=\"0.2\"/>"
      "<joint name=\"hinge\"><origin codesign:xyz=\"0 0 ${height}\"/></joint></robot>"};
  const RobotDescription robot = read_urdf(tuned(vendor, {0.5}, {overlay}));
  EXPECT_EQ(robot.name, "vendor");
  EXPECT_EQ(robot.parameters.at(0).value, 0.5);
  EXPECT_EQ(robot.joints.at(0).origin.xyz[2].nominal(), 0.5);
}

TEST(UrdfWriter, BoundsThatAStudyWidenedFollow) {
  const RobotDescription robot = read_urdf(tuned(hinged_arm(""), {0.7}));
  EXPECT_EQ(robot.parameters.at(0).value, 0.7);
  EXPECT_EQ(robot.parameters.at(0).upper, 0.7);
  EXPECT_EQ(robot.parameters.at(0).lower, 0.1);
}

TEST(UrdfWriter, AnotherFrictionLawReadsBackWithTheNumbersThatItUses) {
  const auto friction = [](const std::string& content) {
    return hinged_arm(
        "<codesign:friction mu_static=\"0.2\" codesign:mu_static=\"${length}\" mu_dynamic=\"0.1\" "
        "joint_length=\"0.05\" "
        "joint_width=\"0.05\" pin_radius=\"0.01\" " +
        content + "/>");
  };
  const std::string numbers =
      "bristle_stiffness=\"4000\" bristle_damping=\"7\" codesign:bristle_damping=\"${35*length}\"";
  const SourceText plain = friction(""), lugre = friction("model=\"lugre\" " + numbers),
                   gonthier = friction(
                       "model=\"gonthier\" dwell_time=\"3\" codesign:dwell_time=\"${15*length}\" " +
                       numbers);
  for (const SourceText& urdf : {plain, lugre, gonthier})
    for (const FrictionModel law :
         {FrictionModel::kBrownMcPhee, FrictionModel::kGonthier, FrictionModel::kLuGre}) {
      const std::string text = write_tuned_urdf(urdf, {}, {0.3}, law);
      const FrictionDescription read = *read_urdf({"written.urdf", text}).joints[0].friction,
                                own = *read_urdf(urdf).joints[0].friction;
      EXPECT_EQ(read.model, law);
      EXPECT_EQ(read.mu_static.nominal(), 0.3) << "the twin at the design";
      const bool both =
          own.model != FrictionModel::kBrownMcPhee && law != FrictionModel::kBrownMcPhee;
      EXPECT_EQ(read.bristle_stiffness.nominal(), both ? 4000.0 : 1e4) << text;
      EXPECT_DOUBLE_EQ(read.bristle_damping.nominal(), both ? 10.5 : 10.0) << text;
      const bool dwells = own.model == FrictionModel::kGonthier && law == FrictionModel::kGonthier;
      EXPECT_DOUBLE_EQ(read.dwell_time.nominal(), dwells ? 4.5 : 2.0) << text;
    }
  EXPECT_EQ(write_tuned_urdf(hinged_arm(""), {}, {0.3}, FrictionModel::kLuGre),
            write_tuned_urdf(hinged_arm(""), {}, {0.3}));
}

TEST(UrdfWriter, AnotherFrictionLawInNewtonMetresReadsBack) {
  for (const char* more : {"", " static=\"3\"", " viscous=\"1\" viscous_exponent=\"0.8\""}) {
    const SourceText urdf = hinged_arm(
        std::string("<codesign:friction coulomb=\"2\" transition_velocity=\"0.2\"") + more + "/>");
    const std::string text = write_tuned_urdf(urdf, {}, {0.3}, FrictionModel::kLuGre);
    const FrictionDescription read = *read_urdf({"written.urdf", text}).joints[0].friction;
    EXPECT_EQ(read.model, FrictionModel::kLuGre);
    EXPECT_EQ(text.find("transition_velocity") == std::string::npos, *more == '\0') << text;
  }
}

TEST(UrdfWriter, TheFrictionLawIsThatOfLoopsToo) {
  const RobotDescription robot = read_urdf(
      {"w", write_tuned_urdf(slider_crank(), {}, {0.08, 0.3, 0.05, 0.025}, FrictionModel::kLuGre)});
  int frictions = 0;
  for (const JointDescription& joint : robot.joints) {
    if (!joint.friction) continue;
    ++frictions;
    EXPECT_EQ(joint.friction->model, FrictionModel::kLuGre) << joint.name;
  }
  EXPECT_GT(frictions, 0);
}

TEST(UrdfWriter, Faults) {
  EXPECT_THROW(write_tuned_urdf(hinged_arm(""), {}, {}), InputError);
  EXPECT_THROW(write_tuned_urdf(hinged_arm(""), {}, {std::nan("")}), InputError);
  const SourceText root = hinged_arm(
      R"(<origin xyz="0 0 0.31622776601683794" codesign:xyz="0 0 ${sqrt(length - 0.1)}"/>)");
  EXPECT_NO_THROW(write_tuned_urdf(root, {}, {0.3}));
  EXPECT_THROW(write_tuned_urdf(root, {}, {0.05}), InputError) << "not finite there";
}

TEST(FilledUrdf, HasThePlainNumberBesideEachTwin) {
  const SourceText without = hinged_arm(R"(<origin codesign:xyz="0 -${length} ${2*length}"/>
<dynamics damping="7" codesign:damping="${length/2}"/>)");
  EXPECT_NE(error_of(without).find("lacks its plain attribute"), std::string::npos);
  const std::string text = write_filled_urdf(without, {}).text;
  EXPECT_NE(text.find("xyz=\"0 -0.2 0.4\""), std::string::npos) << text;
  EXPECT_NE(text.find("damping=\"0.1\""), std::string::npos) << "a number that is there follows";
  const RobotDescription robot = read_urdf({"filled.urdf", text});
  EXPECT_EQ(robot.joints[0].origin.xyz[2].nominal(), 0.4);
  EXPECT_EQ(write_filled_urdf({"filled.urdf", text}, {}).text, text);
}

TEST(FilledUrdf, FillsOverlaysAndNamesFaultsByTheirLines) {
  const SourceText overlay = {
      "over.xml",
      R"(<robot name="test" xmlns:codesign="urn:x"><joint name="hinge"><origin codesign:xyz="0 0 ${length}"/></joint></robot>)"};
  EXPECT_NE(write_filled_urdf(hinged_arm(""), {overlay}).text.find("xyz=\"0 0 0.2\""),
            std::string::npos);
  const auto fault_of_filled = [](const std::string& joint) -> std::string {
    try {
      write_filled_urdf(hinged_arm(joint, "<link name=\"arm\"/>"), {});
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE();
    return "";
  };
  EXPECT_NE(fault_of_filled(R"(<origin codesign:xyz="0 0 ${width}"/>)").find("test.urdf:2"),
            std::string::npos);
  EXPECT_NE(fault_of_filled(R"(<origin codesign:xyz="0 0 ${length}"/>)").find("test.urdf:3"),
            std::string::npos)
      << "a fault elsewhere";
}

TEST(FilledUrdf, WarningsHaveTheLinesOfTheFiles) {
  const SourceText model = {"model.urdf",
                            R"(<robot name="test" xmlns:codesign="urn:x">
<codesign:parameter name="length" value="0.2"/><link name="ground"/>
<link name="arm">

  <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
</link>


<joint name="hinge" type="revolute"><parent link="ground"/><child link="arm"/><axis xyz="0 0 1"/>
  <origin codesign:xyz="0 0 ${length}"/>
  <limit lower="1" upper="-1" effort="1" velocity="1"/></joint></robot>)"},
                   overlay = {"over.xml",
                              R"(<robot name="test">


<link name="arm"><visual><geometry><sphere radius="-1"/></geometry></visual></link></robot>)"};
  const SourceText filled = write_filled_urdf(model, {overlay});
  const RobotDescription robot = read_urdf(filled);
  const auto line_of = [&](const std::string& code) {
    for (const Warning& warning : robot.warnings)
      if (warning.code == code)
        return warning.where.file + ":" + std::to_string(warning.where.line);
    return std::string("none");
  };
  EXPECT_EQ(line_of("limits_reversed"), "model.urdf:11");
  EXPECT_NE(filled.text.find("radius"), std::string::npos);
}

TEST(UrdfWriter, AnotherFrictionLawLeavesContactsAsTheyAre) {
  const std::string friction =
      "<codesign:friction model='stribeck' mu_static='0.2' mu_dynamic='0.1'/>";
  const SourceText urdf = robot_text(
      kGround + link_with("arm") +
      joint_with("pin", "continuous", "ground", "arm",
                 "<axis xyz='0 1 0'/><codesign:clearance radial='1e-4' radius='0.01' "
                 "stiffness='1e8'>" +
                     friction + "</codesign:clearance>") +
      "<codesign:contact name='foot' stiffness='1e6'><predecessor link='ground' shape='plane'/>"
      "<successor link='arm' shape='sphere' radius='0.1'/>" +
      friction + "</codesign:contact>");
  const std::vector<double> parameters(read_urdf(urdf).parameters.size(), 0.3);
  for (const FrictionModel law :
       {FrictionModel::kBrownMcPhee, FrictionModel::kGonthier, FrictionModel::kLuGre})
    EXPECT_EQ(write_tuned_urdf(urdf, {}, parameters, law), write_tuned_urdf(urdf, {}, parameters));
}

}  // namespace
}  // namespace codesign
