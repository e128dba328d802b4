// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/signal_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "description/formula.h"
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

std::string numbers(int count, const std::function<double(int)>& number) {
  std::string text;
  for (int k = 0; k < count; ++k) text += (k > 0 ? ", " : "") + std::to_string(number(k));
  return "[" + text + "]";
}

/// The function of a table of crank_joint/position, and of the parameter a if a value has it.
std::function<double(double)> function_of(const std::string& keys, double a = 0.0) {
  const Study study = with_table(", signal: crank_joint/position, " + keys);
  const SignalFormula& formula = *study.loads.at(0).effort.of_signals->formula;
  return [steps = formula.steps, names = formula.names, a](double s) {
    std::vector<double> variables;
    for (const std::string& name : names) variables.push_back(name == "a" ? a : s);
    return evaluate_formula<double>(steps, In<double>(variables));
  };
}

double slope(const std::function<double(double)>& f, double s, double h) {
  return (f(s + h) - f(s - h)) / (2.0 * h);
}

TEST(SignalTable, HasAnyNumberOfPoints) {
  constexpr int kCount = 3000;
  const auto place = [](int k) { return -1.5 + 0.001 * k; };
  const std::string keys = "at: " + numbers(kCount, place) + ", values: " +
                           numbers(kCount, [&](int k) { return std::sin(place(k)); });
  for (const char* interpolation : {"cubic", "linear"}) {
    const auto f = function_of(keys + ", interpolation: " + interpolation);
    for (const double s : {-1.5, -1.2345, 0.0, 0.0004, 1.0, 1.4985})
      EXPECT_NEAR(f(s), std::sin(s), 2e-6) << interpolation << " " << s;
    EXPECT_NEAR(f(3.0) - f(2.0), slope(f, 5.0, 1.0), 1e-9) << "beyond its end a line";
  }
}

// The natural spline through (0, 0), (1, 1), (2, 0) is s (3 - s^2)/2 before 1.
TEST(SignalTable, CubicIsTheNaturalSpline) {
  for (const char* values : {"[0, 1, 0]", "[0, \"${a}\", 0]"}) {
    const auto f = function_of(std::string("at: [0, 1, 2], values: ") + values, 1.0);
    for (const double s : {0.0, 0.25, 0.5, 1.0}) {
      EXPECT_NEAR(f(s), 0.5 * s * (3.0 - s * s), 1e-15) << values << " " << s;
      EXPECT_NEAR(f(2.0 - s), f(s), 1e-15);
    }
    EXPECT_NEAR(f(-2.0), -3.0, 1e-14);
    EXPECT_NEAR(f(5.0), -4.5, 1e-14);
  }
}

TEST(SignalTable, RepeatsItsPeriod) {
  constexpr int kCount = 25;
  const double step = 2.0 * M_PI / (kCount - 1);
  std::string at, values;
  for (int k = 0; k < kCount; ++k) {
    at += (k > 0 ? ", " : "") + std::to_string(0.5 + step * k);
    values += (k > 0 ? ", " : "") + std::to_string(std::sin(0.5 + step * (k % (kCount - 1))));
  }
  const std::string keys = "at: [" + at + "], values: [" + values + "], periodic: true";
  const auto cubic = function_of(keys), linear = function_of(keys + ", interpolation: linear");
  for (const double s : {-20.0, -1.0, 0.4, 0.5, 1.7, 7.0, 100.0}) {
    EXPECT_NEAR(cubic(s), std::sin(s), 1e-4) << s;
    EXPECT_NEAR(linear(s), std::sin(s), 0.01) << s;
  }
  // Slope and curvature are continuous where periods meet.
  EXPECT_NEAR(slope(cubic, 0.5 + 24 * step, 1e-4), std::cos(0.5), 1e-3);
  const auto second = [&](double s) {
    return (cubic(s + 1e-3) - 2.0 * cubic(s) + cubic(s - 1e-3)) / 1e-6;
  };
  EXPECT_NEAR(second(0.5 - 2e-3), second(0.5 + 2e-3), 0.01);
  const auto three =
      function_of("at: [0, 1, 2], values: [\"${a}\", 1, \"${a}\"], periodic: true", -1.0);
  EXPECT_NEAR(three(0.5), 0.0, 1e-15) << "between two extrema";
  EXPECT_NEAR(three(1001.5), 0.0, 1e-12);
  EXPECT_NEAR(slope(three, 2.0, 1e-5), 0.0, 1e-4);
}

TEST(SignalTable, TellsWhatIsWrong) {
  const std::string position = ", signal: crank_joint/position";
  const std::vector<std::array<std::string, 3>> wrong{
      {position + ", at: [0, 1, 1], values: [0, 1, 2]", "must ascend", "more than 1"},
      {position + ", at: [0], values: [0]", "a table has 1 values", "2 or more"},
      {position + ", at: [0, 1], values: [0, 1, 2]", "found 3 values for 2", "one per value"},
      {position + ", at: [0, 1], values: [0, tall]", "tall", ""},
      {", signal: \"${2*a}\", at: [0, 1], values: [0, 1]", "no signal", "slide/position"},
      {", signal: crank_joint/speed, at: [0, 1], values: [0, 1]", "speed", ""},
      {position + ", at: [0, 1], values: [0, 1], interpolation: monotone", "monotone", "cubic"},
      {position + ", at: [0, 1, 2], values: [0, 1, 2], periodic: true", "differs from the first",
       "(0)"},
      {position + ", at: [0, 1, 2], values: [\"${a}\", 1, 0.5], periodic: true",
       "differs from the first", "(a)"},
      {position + ", at: [0, 1], values: [0, 1], periodic: 2", "periodic", ""},
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
