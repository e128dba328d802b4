// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_values.h"

#include <gtest/gtest.h>

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
