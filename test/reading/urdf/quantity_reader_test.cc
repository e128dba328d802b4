// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/quantity_reader.h"

#include <gtest/gtest.h>
#include <cmath>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText with_origin(const std::string& attributes) {
  return hinged_arm("<origin " + attributes + "/>");
}

QuantityVector xyz_of(const std::string& attributes) {
  return read_urdf(with_origin(attributes)).joints[0].origin.xyz;
}

TEST(Twin, MixesNumbersAndExpressions) {
  const QuantityVector xyz =
      xyz_of(R"(xyz="0.5 -0.1 0.4" codesign:xyz="0.5 -${length/2} ${2 * length}")");
  EXPECT_TRUE(xyz[0].is_constant());
  EXPECT_DOUBLE_EQ(xyz[1].nominal(), -0.1);
  EXPECT_DOUBLE_EQ(xyz[1].at(std::vector<double>{0.3}), -0.15);
  EXPECT_DOUBLE_EQ(xyz[2].at(std::vector<double>{0.3}), 0.6);
}

TEST(Twin, ASignBeforeAnExpressionAppliesToTheWhole) {
  EXPECT_DOUBLE_EQ(
      xyz_of(R"(xyz="-0.3 0.3 0" codesign:xyz="-${length + 0.1} +${length + 0.1} 0")")[0].at(
          std::vector<double>{0.3}),
      -0.4);
}

TEST(Twin, MustEqualThePlainValue) {
  expect_error(with_origin(R"(xyz="0 0 0.3" codesign:xyz="0 0 ${length}")"),
               {"test.urdf:2: <joint name=\"hinge\"> <origin>: ",
                "codesign:xyz is 0 0 0.2 at the default parameters, xyz is 0 0 0.3"});
  EXPECT_NO_THROW(xyz_of(R"(xyz="0 0 0.2000001" codesign:xyz="0 0 ${length}")"));
  expect_error(with_origin(R"(xyz="0 0 0.200001" codesign:xyz="0 0 ${length}")"), {"equal values"});
  EXPECT_NO_THROW(xyz_of(R"(xyz="0 0 1e-13" codesign:xyz="0 0 ${length - length}")"));
}

TEST(Twin, OfVisualsAreCheckedToo) {
  const auto visual = [](const char* box) {
    return robot_text(link_with(
        "ground", std::string("<visual><geometry><box ") + box + "/></geometry></visual>"));
  };
  EXPECT_NO_THROW(read_urdf(visual(R"(size="1 1 0.2" codesign:size="1 1 ${length}")")));
  expect_error(visual(R"(size="1 1 0.3" codesign:size="1 1 ${length}")"),
               {"<link name=\"ground\"> <visual> <geometry> <box>", "equal values"});
}

class QuantityReader : public ::testing::Test {
 protected:
  XmlDocument document_{
      {"a.urdf",
       R"(<robot zero="0" minus="-1" a="0.5" codesign:a="${p}" xyz="0 0 0"><x><origin xyz="1 2 3"/></x><y/></robot>)"}};
  XmlElement robot_{document_.robot(), &document_};
  ParameterTable table_{{Parameter{"p", 0.5, 0.0, 1.0, "", {}}}};
};

TEST_F(QuantityReader, RangesAreChecked) {
  EXPECT_EQ(read_quantity(robot_, "minus", Range::kAny, table_).nominal(), -1.0);
  EXPECT_EQ(read_quantity(robot_, "zero", Range::kNonNegative, table_).nominal(), 0.0);
  EXPECT_THROW(read_quantity(robot_, "minus", Range::kNonNegative, table_), InputError);
  EXPECT_THROW(read_quantity(robot_, "zero", Range::kPositive, table_), InputError);
}

TEST_F(QuantityReader, FallbacksStandInForWhatIsMissing) {
  EXPECT_EQ(read_quantity_or(7.0, robot_, "none", Range::kPositive, table_).nominal(), 7.0);
  EXPECT_EQ(
      read_quantity_or(7.0, robot_, "a", Range::kPositive, table_).at(std::vector<double>{0.6}),
      0.6);
  EXPECT_EQ(read_number_or(7.0, robot_, "none", Range::kAny), 7.0);
  EXPECT_EQ(read_number_or(7.0, robot_, "minus", Range::kAny), -1.0);
  EXPECT_THROW(read_number(robot_, "none", Range::kAny), InputError);
  EXPECT_THROW(read_number(robot_, "a", Range::kAny), InputError) << "it names a parameter";
}

TEST_F(QuantityReader, OriginsAndAxes) {
  EXPECT_EQ(read_origin(robot_.only("x"), table_).xyz[2].nominal(), 3.0);
  EXPECT_EQ(read_origin(robot_.only("y"), table_).xyz[2].nominal(), 0.0);
  EXPECT_THROW(read_axis(robot_, table_), InputError);
  EXPECT_EQ(read_axis(robot_.only("x").only("origin"), table_)[0].nominal(), 1.0);
}

SourceText with_parameter(const std::string& attributes) {
  return {"test.urdf",
          "<robot name=\"x\" xmlns:codesign=\"urn:x\"><link name=\"a\"/>\n<codesign:parameter " +
              attributes + "/></robot>"};
}

TEST(ParameterReader, ReadsValueBoundsAndUnit) {
  const Parameter p =
      read_urdf(with_parameter(R"(name="rod_length" value="0.3" lower="0.2" upper="0.4" unit="m")"))
          .parameters.at(0);
  EXPECT_EQ(p.name, "rod_length");
  EXPECT_EQ(p.value, 0.3);
  EXPECT_EQ(p.lower, 0.2);
  EXPECT_EQ(p.upper, 0.4);
  EXPECT_EQ(p.unit, "m");
  EXPECT_EQ(p.where.line, 2);
}

TEST(ParameterReader, BoundsMayBeOpen) {
  const Parameter p = read_urdf(with_parameter(R"(name="k" value="-3")")).parameters.at(0);
  EXPECT_TRUE(std::isinf(p.lower) && p.lower < 0.0);
  EXPECT_TRUE(std::isinf(p.upper) && p.upper > 0.0);
}

}  // namespace
}  // namespace codesign
