// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/twin.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText with_origin(const std::string& attributes) { return pendulum("<origin " + attributes + "/>"); }

QuantityVector xyz_of(const std::string& attributes) { return read_urdf(with_origin(attributes)).joints[0].origin.xyz; }

TEST(Twin, MixesNumbersAndExpressions) {
  const QuantityVector xyz = xyz_of(R"(xyz="0.5 -0.1 0.4" codesign:xyz="0.5 -${length/2} ${2 * length}")");
  EXPECT_TRUE(xyz[0].is_constant());
  EXPECT_DOUBLE_EQ(xyz[1].nominal(), -0.1);
  EXPECT_DOUBLE_EQ(xyz[1].at(std::vector<double>{0.3}), -0.15);
  EXPECT_DOUBLE_EQ(xyz[2].at(std::vector<double>{0.3}), 0.6);
}

TEST(Twin, ASignBeforeAnExpressionAppliesToTheWhole) {
  EXPECT_DOUBLE_EQ(xyz_of(R"(xyz="-0.3 0.3 0" codesign:xyz="-${length + 0.1} +${length + 0.1} 0")")[0].at(std::vector<double>{0.3}), -0.4);
}

TEST(Twin, MustEqualThePlainValue) {
  expect_error(with_origin(R"(xyz="0 0 0.3" codesign:xyz="0 0 ${length}")"),
               {"test.urdf:2: <joint name=\"hinge\"> <origin>: ", "codesign:xyz is 0 0 0.2 at the default parameters, xyz is 0 0 0.3"});
  EXPECT_NO_THROW(xyz_of(R"(xyz="0 0 0.2000001" codesign:xyz="0 0 ${length}")"));
  expect_error(with_origin(R"(xyz="0 0 0.200001" codesign:xyz="0 0 ${length}")"), {"equal values"});
  EXPECT_NO_THROW(xyz_of(R"(xyz="0 0 1e-13" codesign:xyz="0 0 ${length - length}")"));
}

TEST(Twin, BadExpressions) {
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 ${lenght}")"),
               {"unknown name 'lenght', did you mean 'length'?", "value: 0 0 ${lenght}"});
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 ${length*}")"), {"a number is missing"});
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 ${length")"), {"${ without its }"});
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 length")"), {"'length' in codesign:xyz is not a number"});
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 2${length}")"), {"'2${length}' is not an expression"});
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 0 ${sqrt(-length)}")"), {"not finite at the default parameters"});
  expect_error(with_origin(R"(xyz="0 0 ${length}")"), {"a plain attribute contains an expression", "codesign:xyz"});
}

TEST(Twin, BadNumbers) {
  expect_error(with_origin(R"(xyz="0 0 zero")"), {"'zero' in xyz is not a number"});
  expect_error(with_origin(R"(xyz="0 0 1.2.3")"), {"is not a number"});
  expect_error(with_origin(R"(xyz="0 0 nan")"), {"xyz is not finite"});
  expect_error(with_origin(R"(xyz="0 0 -inf")"), {"xyz is not finite"});
  expect_error(with_origin(R"(xyz="0 0 1e999")"), {"is not a number"});
  expect_error(with_origin(R"(xyz="0 0")"), {"wrong number of values (2)", "3 values"});
  expect_error(with_origin(R"(xyz="")"), {"the attribute xyz is empty"});
}

TEST(Twin, CountsOfTwinAndPlainMustAgree) {
  expect_error(with_origin(R"(xyz="0 0 0.2" codesign:xyz="0 ${length}")"), {"codesign:xyz has the wrong number"});
}

TEST(Twin, OfVisualsAreCheckedToo) {
  const auto visual = [](const char* box) {
    return robot_text(link_with("ground", std::string("<visual><geometry><box ") + box + "/></geometry></visual>"));
  };
  EXPECT_NO_THROW(read_urdf(visual(R"(size="1 1 0.2" codesign:size="1 1 ${length}")")));
  expect_error(visual(R"(size="1 1 0.3" codesign:size="1 1 ${length}")"),
               {"<link name=\"ground\"> <visual> <geometry> <box>", "equal values"});
}

}  // namespace
}  // namespace codesign
