// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/signal.h"
#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

Quantity read(const std::string& yaml) {
  return read_quantity(YamlValue::parse({"study.yaml", yaml}).at("x"),
                       ParameterTable(study_robot().parameters));
}

TEST(StudyValues, AQuantityIsANumberOrAnExpression) {
  EXPECT_EQ(read("x: -2.5").nominal(), -2.5);
  EXPECT_TRUE(read("x: '1e-6'").is_constant());
  const Quantity quantity = read("x: \"${rod_length - 2*crank_length}\"");
  EXPECT_DOUBLE_EQ(quantity.nominal(), 0.14);
  EXPECT_DOUBLE_EQ(quantity.at(std::vector<double>{0.1, 0.4}), 0.2);
}

TEST(StudyValues, RefusesOtherThings) {
  for (const char* text :
       {"x: two", "x: rod_length", "x: \"${\"", "x: \"${}\"", "x: \"2*${rod_length}\"", "x: .inf",
        "x: \"${1/0}\"", "x: \"${rod_lenght}\"", "x: \"${2 +}\"", "x: []", "x: ''"})
    EXPECT_THROW(read(text), InputError) << text;
}

TEST(StudyValues, SaysWhatAQuantityMayBe) {
  try {
    read("x: two");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().value, "two");
    EXPECT_EQ(error.fault().allowed, "a finite number or \"${expression}\" of the parameters");
  }
}

// Bounds are allowed values; a number that is not one is not.
TEST(StudyValues, AValueStaysWithinTheBoundsOfItsParameter) {
  Parameter mass;
  mass.name = "mass";
  mass.lower = 0.5;
  mass.upper = 2.0;
  for (const double value : {0.5, 1.0, 2.0})
    EXPECT_NO_THROW(require_within_bounds(value, mass, {"f", 3}, "set.mass")) << value;
  for (const double value : {0.499, 2.001, std::nan(""), HUGE_VAL}) try {
      require_within_bounds(value, mass, {"f", 3}, "set.mass");
      ADD_FAILURE() << value;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 3);
      EXPECT_EQ(error.fault().element, "set.mass");
      EXPECT_EQ(error.fault().allowed, "[0.5, 2]");
      EXPECT_NE(error.fault().message.find("mass"), std::string::npos);
    }
  mass.upper = HUGE_VAL;
  EXPECT_THROW(require_within_bounds(HUGE_VAL, mass, {"f", 3}, "set.mass"), InputError);
}

TEST(StudyValues, AnExpressionOfSignalsReadsParametersAndTheTime) {
  const auto require = [](const char* text) {
    require_known(parse_signal(text, {"f", 3}, "signals"), {"mass"}, {"f", 3}, "signals");
  };
  for (const char* good : {"a/position", "${mass*a/position + t}"})
    EXPECT_NO_THROW(require(good)) << good;
  try {
    require("${2*mas*a/position}");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().message, "unknown parameter, did you mean \"mass\"?");
    EXPECT_EQ(error.fault().allowed, "mass, t");
    EXPECT_EQ(error.fault().element, "signals");
  }
}

TEST(StudyValues, FindsParametersThatAreNotTuned) {
  const YamlValue at =
      YamlValue::parse({"study.yaml", "set: {rod_length: 0.25, short: 0.1}"}).at("set");
  Study study;
  study.parameters = study_robot().parameters;
  study.tuned = {0};
  EXPECT_EQ(untuned_parameter("rod_length", study, at), 1);
  EXPECT_THROW(untuned_parameter("crank_length", study, at), InputError);
  try {
    untuned_parameter("rod", study, at, {"another"});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().allowed, "another, rod_length");
  }
  EXPECT_EQ(read_within_bounds(at.at("rod_length"), study.parameters[1]), 0.25);
  EXPECT_THROW(read_within_bounds(at.at("short"), study.parameters[1]), InputError);
}

}  // namespace
}  // namespace codesign
