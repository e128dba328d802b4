// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/saved_result.h"

#include <gtest/gtest.h>

#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

InputFault fault_in(const std::string& json) {
  try {
    read_result({"result.json", json});
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().where.file, "result.json");
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << json;
  return {};
}

TEST(SavedResult, HoldsEveryParameterToTheLastBit) {
  const ParameterSettings settings =
      read_result({"result.json", R"({"objective": 1, "parameters": {"a": 0.1, "Kp": 5, "b": 0.22358268481765226}})"});
  EXPECT_EQ(settings, (ParameterSettings{{"a", 0.1}, {"Kp", 5.0}, {"b", 0.22358268481765226}}));
}

TEST(SavedResult, SaysWhatIsWrong) {
  EXPECT_EQ(fault_in("{\n\"parameters\": {\n\"a\": }}").where.line, 3);
  EXPECT_EQ(fault_in("[1, 2]").element, "parameters");
  EXPECT_EQ(fault_in("{}").element, "parameters");
  EXPECT_EQ(fault_in("{\"parameters\": 3}").element, "parameters");
  const InputFault fault = fault_in("{\"parameters\": {\"a\": null}}");
  EXPECT_EQ(fault.element, "parameters.a");
  EXPECT_EQ(fault.value, "null");
  EXPECT_EQ(fault_in("{\n\"parameters\": {\"b\": 1,\n\"a\": true}}").where.line, 3);
  const InputFault beyond = fault_in("{\"3e999\": [\"\\\"4e999\", 5e-999],\n\"parameters\": {\n\"a\": 1, \"b\": -1e999}}");
  EXPECT_EQ(beyond.where.line, 3);
  EXPECT_EQ(beyond.value, "1e999");
  EXPECT_EQ(beyond.message, "a number is beyond the range of double");
  const std::string deep(100000, '[');
  EXPECT_EQ(fault_in("{\"parameters\": {\"a\": " + deep + std::string(deep.size(), ']') + "}}").value, "array");
}

}  // namespace
}  // namespace codesign
