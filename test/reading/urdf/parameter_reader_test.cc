// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/parameter_reader.h"

#include <cmath>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText with_parameter(const std::string& attributes) {
  return {"test.urdf", "<robot name=\"x\" xmlns:codesign=\"urn:x\"><link name=\"a\"/>\n<codesign:parameter " + attributes + "/></robot>"};
}

TEST(ParameterReader, ReadsValueBoundsAndUnit) {
  const Parameter p = read_urdf(with_parameter(R"(name="rod_length" value="0.3" lower="0.2" upper="0.4" unit="m")")).parameters.at(0);
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

TEST(ParameterReader, Faults) {
  expect_error(with_parameter(R"(name="k" value="0.5" lower="1" upper="2")"),
               {"test.urdf:2:", "outside its bounds", "value: 0.5, allowed: [1, 2]"});
  expect_error(with_parameter(R"(name="k" value="1.5" lower="2" upper="1")"),
               {"the lower bound is above the upper bound", "at most upper=1"});
  expect_error(with_parameter(R"(name="k")"), {"the attribute value is missing"});
  expect_error(with_parameter(R"(value="1")"), {"the attribute name is missing"});
  expect_error(with_parameter(R"(name="k" value="inf")"), {"value is not finite"});
  expect_error(with_parameter(R"(name="k" value="one")"), {"'one' in value is not a number"});
  expect_error(with_parameter(R"(name="2k" value="1")"), {"'2k' is not an identifier"});
  expect_error(with_parameter(R"(name="sin" value="1")"), {"'sin' is a function or constant of expressions"});
  expect_error(with_parameter(R"(name="k" value="1" min="0")"), {"unknown attribute min"});
  expect_error(with_parameter("name=\"k\" value=\"1\"/>\n<codesign:parameter name=\"k\" value=\"2\""),
               {"test.urdf:3:", "a second parameter of this name"});
}

}  // namespace
}  // namespace codesign
