// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include <map>

#include "reading/page_rows.h"
#include "reading/urdf/urdf_fixture.h"
#include "text/number_text.h"

namespace codesign {
namespace {

const char kPlain[] = R"(mu_static="0.4" mu_dynamic="0.3" joint_length="0.1" pin_radius="0.02")";

SourceText text_with(const std::string& attributes) {
  return hinged_arm("\n<codesign:friction " + attributes + "/>");
}
FrictionDescription friction(const std::string& attributes) {
  return *read_urdf(text_with(attributes)).joints.at(0).friction;
}

TEST(FrictionReader, Defaults) {
  const FrictionDescription f = friction(kPlain);
  EXPECT_EQ(f.model, FrictionModel::kBrownMcPhee);
  EXPECT_EQ(f.mu_static.nominal(), 0.4);
  EXPECT_EQ(f.mu_dynamic.nominal(), 0.3);
  EXPECT_EQ(f.transition_velocity.nominal(), FrictionDescription().transition_velocity.nominal());
  EXPECT_TRUE(f.smoothing.is_zero()) << "follows the machine";
  EXPECT_EQ(f.friction_arm.nominal(), 0.02) << "the pin's radius";
  EXPECT_EQ(f.preload.nominal(), 0.0);
  EXPECT_EQ(f.viscous.nominal(), 0.0);
  EXPECT_FALSE(f.transverse_axis);
  EXPECT_EQ(f.bristle_stiffness.nominal(), 1e4);
  EXPECT_EQ(f.bristle_damping.nominal(), 10.0);
  EXPECT_EQ(f.dwell_time.nominal(), 2.0);
  EXPECT_EQ(f.where.line, 3);
}

/// The default that doc/annotations.md gives for a missing number.
std::string shown_default(const FrictionNumberRule& rule) {
  using M = FrictionNumberRule::Missing;
  static const std::map<M, std::string> kWords = {{M::kRefused, "required"},
                                                  {M::kLengthOfOne, "none"},
                                                  {M::kOfMachine, "1e-5 of the weight"},
                                                  {M::kPinRadius, "`pin_radius`"},
                                                  {M::kMuStatic, "`mu_static`"},
                                                  {M::kMuDynamic, "`mu_dynamic`"},
                                                  {M::kViscous, "`viscous`"},
                                                  {M::kCoulomb, "`coulomb`"},
                                                  {M::kStatic, "`static`, else `coulomb_backward`"},
                                                  {M::kTenTransitions, "10 `transition_velocity`"}};
  const bool is_none = rule.standard == 0.0 && !rule.zero_allowed;
  return rule.missing != M::kStandard ? kWords.at(rule.missing)
         : is_none                    ? "none"
                                      : to_decimal(rule.standard);
}

TEST(FrictionReader, HasTheAttributesOfThePage) {
  std::map<std::string, std::pair<std::string, std::string>> page;  // default and allowed values
  for (const PageRow& row : page_rows("annotations.md", 4))
    for (std::size_t k = 0; k < row.keys.size(); ++k)
      page[row.keys[k]] = {row.part(2, k), row.part(3, k)};
  visit_friction_numbers([&](const FrictionNumberRule& rule) {
    ASSERT_EQ(page.count(rule.attribute), 1U) << rule.attribute;
    const auto [standard, allowed] = page[rule.attribute];
    const std::optional<double> number = parse_number(standard);
    EXPECT_EQ(number ? to_decimal(*number) : standard, shown_default(rule)) << rule.attribute;
    EXPECT_EQ(allowed.rfind("> 0", 0) == 0, !rule.zero_allowed) << rule.attribute;
    page.erase(rule.attribute);
  });
  page.erase("model");
  page.erase("transverse_axis");
  EXPECT_TRUE(page.empty()) << page.begin()->first;
}

TEST(FrictionReader, AllAttributesAndTwins) {
  const FrictionDescription f =
      friction(R"(model="gonthier" mu_static="0.4" codesign:mu_static="${2*length}" mu_dynamic="0.2"
      transition_velocity="0.001" joint_length="0.2" codesign:joint_length="${length}" joint_width="0.3" pin_radius="0.02" friction_arm="0.03"
      preload="5" smoothing="0.01" viscous="0.5" transverse_axis="0 0 1" bristle_stiffness="3e4" bristle_damping="20" dwell_time="1.5"
      codesign:dwell_time="${7.5*length}")");
  const std::vector<double> at = {0.3};
  EXPECT_EQ(f.model, FrictionModel::kGonthier);
  EXPECT_DOUBLE_EQ(f.mu_static.at(at), 0.6);
  EXPECT_DOUBLE_EQ(f.joint_length.at(at), 0.3);
  EXPECT_EQ(f.transition_velocity.nominal(), 0.001);
  EXPECT_EQ(f.joint_width.nominal(), 0.3);
  EXPECT_EQ(f.friction_arm.nominal(), 0.03);
  EXPECT_EQ(f.preload.nominal(), 5.0);
  EXPECT_EQ(f.smoothing.nominal(), 0.01);
  EXPECT_EQ(f.viscous.nominal(), 0.5);
  EXPECT_EQ((*f.transverse_axis)[2], 1.0);
  EXPECT_EQ(f.bristle_stiffness.nominal(), 3e4);
  EXPECT_EQ(f.bristle_damping.nominal(), 20.0);
  EXPECT_DOUBLE_EQ(f.dwell_time.at(std::vector<double>{0.4}), 3.0);
  EXPECT_EQ(friction(std::string(kPlain) + " model=\"lugre\"").model, FrictionModel::kLuGre);
}

TEST(FrictionReader, NumbersAgainstTheAxis) {
  const std::string plain = kPlain;
  const FrictionDescription none = friction(plain);
  EXPECT_FALSE(none.is_directional);
  const FrictionDescription f = friction(
      plain + R"( viscous="2" mu_dynamic_backward="0.2" codesign:mu_dynamic_backward="${length}")");
  EXPECT_TRUE(f.is_directional);
  EXPECT_EQ(f.mu_static_backward.nominal(), 0.4) << "as along the axis";
  EXPECT_DOUBLE_EQ(f.mu_dynamic_backward.at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(f.viscous_backward.nominal(), 2.0);
  EXPECT_TRUE(friction(plain + " model=\"lugre\" viscous_backward=\"1\"").is_directional);
  expect_error(text_with(plain + " mu_static_backward=\"0.2\""),
               {"mu_dynamic_backward is above mu_static_backward"});
  expect_error(text_with(plain + " mu_dynamic_backward=\"0.5\""),
               {"mu_dynamic_backward is above mu_static_backward"});
  expect_error(text_with(plain + " viscous_backward=\"-1\""), {"viscous_backward is negative"});
  expect_error(text_with(plain + " model=\"lugre\" mu_static_backward=\"0.5\""),
               {"mu_static_backward has no meaning for this friction model (value: 0.5, allowed: "
                "with model=\"brown_mcphee\" or model=\"stribeck\")"});
  expect_error(text_with(plain + " viscous_backwards=\"1\""),
               {"did you mean \"viscous_backward\"?"});
}

TEST(FrictionReader, InNewtonMetres) {
  const FrictionDescription f =
      friction(R"(coulomb="2" codesign:coulomb="${10*length}" viscous="8" viscous_exponent="0.7")");
  EXPECT_TRUE(f.is_direct);
  EXPECT_TRUE(f.has_exponent);
  EXPECT_FALSE(f.is_directional);
  EXPECT_EQ(f.model, FrictionModel::kStribeck);
  EXPECT_DOUBLE_EQ(f.mu_dynamic.at(std::vector<double>{0.6}), 6.0);
  EXPECT_DOUBLE_EQ(f.mu_static.at(std::vector<double>{0.6}), 6.0) << "as coulomb";
  EXPECT_EQ(f.viscous_exponent.nominal(), 0.7);
  EXPECT_EQ(f.transition_velocity.nominal(), 0.001) << "rad/s, without any mass";
  EXPECT_FALSE(friction(kPlain).is_direct);

  const FrictionDescription lugre = friction(
      R"(model="lugre" coulomb="5" static="7" transition_velocity="0.1" bristle_stiffness="3e4")");
  EXPECT_EQ(lugre.model, FrictionModel::kLuGre);
  EXPECT_EQ(lugre.mu_static.nominal(), 7.0);
}

TEST(FrictionReader, InNewtonMetresByDirection) {
  const FrictionDescription f = friction(R"(coulomb="5" coulomb_backward="6")");
  EXPECT_TRUE(f.is_directional);
  EXPECT_EQ(f.mu_dynamic_backward.nominal(), 6.0);
  EXPECT_EQ(f.mu_static_backward.nominal(), 6.0) << "no static friction is given";
  EXPECT_EQ(friction(R"(coulomb="5" static="7" coulomb_backward="6")").mu_static_backward.nominal(),
            7.0);
}

TEST(FrictionReader, ATransitionVelocityThatLuGresModelDoesNotReadIsRefused) {
  const std::string lugre = "coulomb=\"5\" transition_velocity=\"0.1\" model=\"lugre\" ",
                    message = "transition_velocity has no effect: in the LuGre model";
  expect_error(text_with(lugre), {message, "allowed: beside static or viscous_exponent"});
  EXPECT_EQ(friction(lugre + "static=\"6\"").mu_static.nominal(), 6.0);
  expect_error(hinged_arm("\n<codesign:actuator rotor_inertia=\"1\" " + lugre + "/>"), {message});
}

std::optional<GearDescription> gear(const std::string& attributes) {
  const std::string actuator = "\n<codesign:actuator rotor_inertia=\"1e-5\" " + attributes + "/>";
  return read_urdf(hinged_arm(actuator)).joints.at(0).actuator->gear;
}

TEST(GearReader, EfficienciesAndFrictionOfTheMotor) {
  EXPECT_FALSE(gear("gear_ratio=\"50\""));
  const GearDescription g = *gear(
      R"(gear_ratio="50" efficiency="0.9" codesign:efficiency="${1-length/2}" coulomb="0.01")");
  EXPECT_DOUBLE_EQ(g.efficiency->at(std::vector<double>{0.4}), 0.8);
  EXPECT_FALSE(g.backdrive_efficiency);
  EXPECT_EQ(g.coulomb.nominal(), 0.01);
  EXPECT_EQ(g.viscous.nominal(), 0.0);
  EXPECT_EQ(g.slip.model, FrictionModel::kBrownMcPhee);
  EXPECT_EQ(g.slip.transition_velocity.nominal(), 0.001);
  EXPECT_TRUE(g.slip.smoothing.is_zero()) << "follows the machine";
  EXPECT_FALSE(gear("viscous=\"1e-5\"")->efficiency);
  const GearDescription worm = *gear(
      R"(efficiency="0.4" backdrive_efficiency="-0.6" model="lugre" bristle_stiffness="3e4")");
  EXPECT_EQ(worm.backdrive_efficiency->nominal(), -0.6);
  EXPECT_EQ(worm.slip.bristle_stiffness.nominal(), 3e4);
}

TEST(GearReader, TheTransitionSuitsTheSpeedOfTheJoint) {
  const auto transition = [](const std::string& type, const std::string& more) {
    const RobotDescription robot = read_urdf(robot_text(
        kGround + link_with("arm") +
        joint_with("joint", type, "ground", "arm",
                   "<codesign:actuator rotor_inertia='1' efficiency='0.9'/><codesign:friction "
                   "coulomb='1'/>" +
                       more)));
    EXPECT_EQ(robot.joints[0].friction->transition_velocity.nominal(),
              robot.joints[0].actuator->gear->slip.transition_velocity.nominal());
    return robot.joints[0].friction->transition_velocity.nominal();
  };
  EXPECT_DOUBLE_EQ(transition("continuous", "<limit effort='0' velocity='3'/>"), 0.003);
  EXPECT_EQ(transition("continuous", ""), 0.001);
  EXPECT_EQ(transition("prismatic", "<limit effort='0' velocity='0'/>"), 0.0001);
}

TEST(GearReader, WithoutALimitTheTransitionFollowsTheMachineUnlessItSticks) {
  const auto slip = [](const std::string& more, const std::string& limit) {
    return read_urdf(
               robot_text(kGround + link_with("arm") +
                          joint_with("joint", "continuous", "ground", "arm",
                                     "<codesign:actuator rotor_inertia='1' efficiency='0.9' " +
                                         more + "/>" + limit)))
        .joints[0]
        .actuator->gear->slip;
  };
  const std::string limit = "<limit effort='0' velocity='3'/>";
  EXPECT_TRUE(slip("", "").transition_follows);
  EXPECT_FALSE(slip("", limit).transition_follows);
  EXPECT_FALSE(slip("transition_velocity='0.02'", "").transition_follows);
  EXPECT_FALSE(slip("model='gonthier'", "").transition_follows) << "a Stribeck velocity";
  EXPECT_DOUBLE_EQ(slip("model='gonthier'", limit).transition_velocity.nominal(), 0.03);
}

TEST(ElasticGearReader, StiffnessDampingAndBacklash) {
  const auto actuator = [](const std::string& attributes) {
    return *read_urdf(hinged_arm("<codesign:actuator rotor_inertia='1e-5' " + attributes + "/>"))
                .joints[0]
                .actuator;
  };
  EXPECT_FALSE(actuator("").elastic);
  const ElasticGearDescription plain = *actuator("stiffness='300'").elastic;
  EXPECT_EQ(plain.stiffness.nominal(), 300.0);
  EXPECT_TRUE(plain.damping.is_zero());
  EXPECT_FALSE(plain.backlash);
  const ElasticGearDescription all =
      *actuator(
           "stiffness='300' codesign:stiffness='${1500*length}' damping='2' backlash='0.01' "
           "codesign:backlash='${length/20}'")
           .elastic;
  EXPECT_DOUBLE_EQ(all.stiffness.at(std::vector<double>{0.4}), 600.0);
  EXPECT_EQ(all.damping.nominal(), 2.0);
  EXPECT_DOUBLE_EQ(all.backlash->at(std::vector<double>{0.4}), 0.02);
}

RobotDescription read_geared(
    const std::string& transmissions,
    const std::string& actuator = "<codesign:actuator rotor_inertia=\"1e-5\"/>") {
  return read_urdf(hinged_arm(actuator, transmissions));
}

std::string simple(const std::string& on_actuator, const std::string& on_joint = "",
                   const std::string& below = "") {
  const auto reduction = [](const std::string& x) {
    return x.empty() ? "" : "<mechanicalReduction>" + x + "</mechanicalReduction>";
  };
  return "<transmission name=\"t\"><type>transmission_interface/SimpleTransmission</type><joint "
         "name=\"hinge\">" +
         reduction(on_joint) + "</joint><actuator name=\"motor\">" + reduction(on_actuator) +
         "</actuator>" + reduction(below) + "</transmission>";
}

double ratio_of(const RobotDescription& robot) {
  return robot.joints[0].actuator->gear_ratio.nominal();
}

TEST(TransmissionReader, TheReductionIsTheGearRatio) {
  EXPECT_EQ(ratio_of(read_geared("")), 1.0);
  EXPECT_EQ(ratio_of(read_geared(simple("50"))), 50.0);
  EXPECT_EQ(ratio_of(read_geared(simple("", " -7.5 "))), -7.5);
  EXPECT_EQ(ratio_of(read_geared(simple("", "", "63.16"))), 63.16);
  EXPECT_EQ(ratio_of(read_geared(
                "<transmission type=\"pr2_mechanism_model/SimpleTransmission\" "
                "name=\"t\"><actuator name=\"m\"/><joint "
                "name=\"hinge\"/><mechanicalReduction>20</mechanicalReduction></transmission>")),
            20.0);
  for (const char* none : {"50", ""}) EXPECT_TRUE(read_geared(simple(none)).warnings.empty());
}

TEST(TransmissionReader, TheAnnotationComesFirst) {
  EXPECT_EQ(ratio_of(read_geared(simple("50"),
                                 "<codesign:actuator rotor_inertia=\"1e-5\" gear_ratio=\"3\"/>")),
            3.0);
}

TEST(TransmissionReader, WithoutAnActuatorNothingIsReadOrSaid) {
  const RobotDescription robot = read_geared(simple("x") + simple("50"), "");
  EXPECT_FALSE(robot.joints[0].actuator.has_value());
  EXPECT_TRUE(robot.warnings.empty());
}

void expect_warning(const RobotDescription& robot, const std::string& code,
                    const std::string& value) {
  ASSERT_EQ(robot.warnings.size(), 1U);
  EXPECT_EQ(robot.warnings[0].code, code);
  EXPECT_NE(robot.warnings[0].message.find("value: " + value), std::string::npos)
      << robot.warnings[0].message;
  EXPECT_NE(robot.warnings[0].message.find("gear_ratio"), std::string::npos)
      << robot.warnings[0].message;
  EXPECT_EQ(robot.warnings[0].where.line, 3);
}

TEST(TransmissionReader, WarnsOfWhatItLeavesOut) {
  const RobotDescription unread = read_geared(simple("fifty"));
  EXPECT_EQ(ratio_of(unread), 1.0);
  expect_warning(unread, "transmission_not_read", "fifty");
  const RobotDescription twice = read_geared(simple("50", "2"));
  EXPECT_EQ(ratio_of(twice), 50.0);
  expect_warning(twice, "transmission_contradicts", "2");
  EXPECT_TRUE(read_geared(simple("50", "50")).warnings.empty());
  const RobotDescription other = read_geared(
      "<transmission name=\"t\"><type>transmission_interface/DifferentialTransmission</type><joint "
      "name=\"hinge\"/><joint name=\"b\"/>"
      "<actuator "
      "name=\"m\"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>");
  EXPECT_EQ(ratio_of(other), 1.0);
  expect_warning(other, "transmission_not_simple",
                 "transmission_interface/DifferentialTransmission");
}

}  // namespace
}  // namespace codesign
