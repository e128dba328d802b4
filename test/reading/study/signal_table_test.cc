// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/signal_table.h"

#include <gtest/gtest.h>

#include <array>

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

Study with_table(const std::string& keys) {
  return read_study({"study.yaml", kLeastStudy +
                                       "parameters: {a: {initial: 0.5}}\nloads:\n  - joint: "
                                       "crank_joint\n    effort: {type: table" +
                                       keys + "}\n"},
                    study_robot());
}

TEST(SignalTable, IsAnExpressionOfItsSignal) {
  const Study study = with_table(
      ", signal: crank_joint/position - slider_joint/position, at: [0, 1, 3], values: [1, "
      "\"${2*a}\", -1], interpolation: linear");
  const SignalDescription& signal = *study.loads.at(0).effort.of_signals;
  ASSERT_EQ(signal.terms.size(), 2U);
  EXPECT_EQ(signal.terms[1].object, "slider_joint");
  EXPECT_EQ(study.used_parameters.size(), 1U) << "the second value's";
}

TEST(SignalTable, TellsWhatIsWrong) {
  const std::string position = ", signal: crank_joint/position";
  const std::vector<std::array<std::string, 3>> wrong{
      {position + ", at: [0, 1, 1], values: [0, 1, 2]", "must ascend", "more than 1"},
      {position + ", at: [0], values: [0]", "a table has 1 values", "2 to 100"},
      {position + ", at: [0, 1], values: [0, 1, 2]", "found 3 values for 2", "one per value"},
      {position + ", at: [0, 1], values: [0, tall]", "tall", ""},
      {", signal: \"${2*a}\", at: [0, 1], values: [0, 1]", "no signal", "slide/position"},
      {", signal: crank_joint/speed, at: [0, 1], values: [0, 1]", "speed", ""},
      {position + ", at: [0, 1], values: [0, 1], interpolation: monotone", "monotone", "cubic"},
      {", at: [0, 1], values: [0, 1]", "signal", ""}};
  for (const auto& [keys, message, allowed] : wrong) {
    try {
      with_table(keys);
      ADD_FAILURE() << keys;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.fault().element.rfind("loads[0].effort", 0), 0U) << what;
      EXPECT_NE(what.find(message), std::string::npos) << what;
      EXPECT_NE(what.find(allowed), std::string::npos) << what;
    }
  }
}

}  // namespace
}  // namespace codesign
