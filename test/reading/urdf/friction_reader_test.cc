// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/friction_reader.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

const char kPlain[] = R"(mu_static="0.4" mu_dynamic="0.3" joint_length="0.1" pin_radius="0.02")";

SourceText text_with(const std::string& attributes) { return pendulum("\n<codesign:friction " + attributes + "/>"); }
FrictionDescription friction(const std::string& attributes) { return *read_urdf(text_with(attributes)).joints.at(0).friction; }

TEST(FrictionReader, Defaults) {
  const FrictionDescription f = friction(kPlain);
  EXPECT_EQ(f.model, FrictionModel::kBrownMcPhee);
  EXPECT_EQ(f.mu_static.nominal(), 0.4);
  EXPECT_EQ(f.mu_dynamic.nominal(), 0.3);
  EXPECT_EQ(f.transition_velocity.nominal(), FrictionDescription().transition_velocity.nominal());
  EXPECT_EQ(f.smoothing.nominal(), FrictionDescription().smoothing.nominal());
  EXPECT_EQ(f.friction_arm.nominal(), 0.02) << "the pin's radius";
  EXPECT_EQ(f.preload.nominal(), 0.0);
  EXPECT_EQ(f.viscous.nominal(), 0.0);
  EXPECT_FALSE(f.transverse_axis);
  EXPECT_EQ(f.bristle_stiffness.nominal(), 1e4);
  EXPECT_EQ(f.bristle_damping.nominal(), 10.0);
  EXPECT_EQ(f.dwell_time.nominal(), 2.0);
  EXPECT_EQ(f.where.line, 3);
}

TEST(FrictionReader, AllAttributesAndTwins) {
  const FrictionDescription f = friction(R"(model="gonthier" mu_static="0.4" codesign:mu_static="${2*length}" mu_dynamic="0.2"
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

TEST(FrictionReader, Faults) {
  const std::string plain = kPlain;
  expect_error(text_with(plain + " model=\"brown_mcphe\""),
               {"test.urdf:3: <joint name=\"hinge\"> <codesign:friction>: unknown friction model, did you mean \"brown_mcphee\"?"});
  expect_error(text_with("mu_static=\"0.4\""), {"the attribute mu_dynamic is missing"});
  expect_error(text_with("mu_dynamic=\"0.4\""), {"the attribute mu_static is missing"});
  expect_error(text_with("mu_static=\"0.3\" mu_dynamic=\"0.4\""),
               {"mu_dynamic is above mu_static (value: 0.4, allowed: at most mu_static=0.3)"});
  expect_error(text_with("mu_static=\"0.3\" mu_dynamic=\"-0.4\""), {"mu_dynamic is negative"});
  for (const char* name : {"transition_velocity", "smoothing", "friction_arm", "joint_width"})
    expect_error(text_with(plain + " " + name + "=\"0\""), {std::string(name) + " is not positive (value: 0, allowed: > 0)"});
  for (const char* name : {"bristle_stiffness", "bristle_damping", "dwell_time"})
    expect_error(text_with(plain + " model=\"gonthier\" " + name + "=\"0\""), {std::string(name) + " is not positive"});
  for (const char* name : {"preload", "viscous"})
    expect_error(text_with(plain + " " + name + "=\"-1\""), {std::string(name) + " is negative"});
  expect_error(text_with(plain + " transverse_axis=\"2 0 0\""), {"zero or parallel to the joint axis"});
  expect_error(text_with(plain + " transverse_axis=\"0 0 0\""), {"zero or parallel to the joint axis"});
  expect_error(text_with(plain + " transverse_axis=\"0 1\""), {"wrong number"});
}

TEST(FrictionReader, NumbersAgainstTheAxis) {
  const std::string plain = kPlain;
  const FrictionDescription none = friction(plain);
  EXPECT_FALSE(none.is_directional);
  const FrictionDescription f = friction(plain + R"( viscous="2" mu_dynamic_backward="0.2" codesign:mu_dynamic_backward="${length}")");
  EXPECT_TRUE(f.is_directional);
  EXPECT_EQ(f.mu_static_backward.nominal(), 0.4) << "as along the axis";
  EXPECT_DOUBLE_EQ(f.mu_dynamic_backward.at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(f.viscous_backward.nominal(), 2.0);
  EXPECT_TRUE(friction(plain + " model=\"lugre\" viscous_backward=\"1\"").is_directional);
  expect_error(text_with(plain + " mu_static_backward=\"0.2\""), {"mu_dynamic_backward is above mu_static_backward"});
  expect_error(text_with(plain + " mu_dynamic_backward=\"0.5\""), {"mu_dynamic_backward is above mu_static_backward"});
  expect_error(text_with(plain + " viscous_backward=\"-1\""), {"viscous_backward is negative"});
  expect_error(text_with(plain + " model=\"lugre\" mu_static_backward=\"0.5\""),
               {"mu_static_backward has no meaning for this friction model (value: 0.5, allowed: with model=\"brown_mcphee\")"});
  expect_error(text_with(plain + " viscous_backwards=\"1\""), {"did you mean \"viscous_backward\"?"});
}

TEST(FrictionReader, AttributesBelongToTheirModels) {
  const std::string plain = kPlain;
  expect_error(
      text_with(plain + " bristle_stiffness=\"1e4\""),
      {"bristle_stiffness has no meaning for this friction model (value: 1e4, allowed: with model=\"gonthier\" or model=\"lugre\")"});
  expect_error(text_with(plain + " bristle_damping=\"10\""), {"bristle_damping has no meaning"});
  expect_error(text_with(plain + " model=\"lugre\" dwell_time=\"1\""),
               {"dwell_time has no meaning for this friction model (value: 1, allowed: with model=\"gonthier\")"});
  expect_error(text_with(plain + " model=\"gonthier\" bristle_stifness=\"1e4\""), {"did you mean \"bristle_stiffness\"?"});
  expect_error(text_with("model=\"lugre\" mu_static=\"0.3\" mu_dynamic=\"0\""), {"mu_dynamic is zero: the LuGre model divides by it"});
}

}  // namespace
}  // namespace codesign
