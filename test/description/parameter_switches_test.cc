// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/parameter_switches.h"

#include <gtest/gtest.h>

#include <string>

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

/// Variables a, b are parameters 0 and 1, t is the time, s a signal.
std::string switches_in(const std::string& text, bool at_instant = false) {
  const Expression expression(text, {"a", "b", "t", "s"});
  const auto variable = [&](int k) -> ExpressionVariable {
    const int index = expression.dependencies()[static_cast<std::size_t>(k)];
    if (index == 2) return {VariableKind::kTime, -1};
    if (index == 3) return {VariableKind::kSignal, -1};
    return {VariableKind::kParameter, index};
  };
  std::string found;
  for (const ParameterSwitch& one :
       find_switches(expression.steps(), expression.text(), variable, at_instant)) {
    found += one.text + ":";
    for (const int parameter : one.parameters) found += std::to_string(parameter);
    found += ";";
  }
  return found;
}

TEST(ParameterSwitches, AreStaircasesAndComparisonsOfParameters) {
  EXPECT_EQ(switches_in("2*floor(3*a) + b"), "floor(3*a):0;");
  EXPECT_EQ(switches_in("ceil(a/b)*sign(b)"), "ceil(a/b):01;sign(b):1;");
  EXPECT_EQ(switches_in("(a < 2 ? b : (b >= 1 ? a : 3))*s"), "a < 2:0;b >= 1:1;");
  EXPECT_EQ(switches_in("floor((a > 1 ? b : 2))"), "a > 1:0;floor((a > 1 ? b : 2)):01;")
      << "what a condition chooses depends on it";
  EXPECT_EQ(switches_in("abs(a) + max(a, b) - floor(3.7) + (2 < 3 ? a : b)"), "");
}

TEST(ParameterSwitches, OfTimeAndSignalsARunPasses) {
  EXPECT_EQ(switches_in("floor(t/a) + (t < b ? 1 : 0) + sign(s - a)"), "");
  EXPECT_EQ(switches_in("(s > 0 ? floor(b) : 0)"), "floor(b):1;");
  EXPECT_EQ(switches_in("floor(t/a) + (t < b ? 1 : 0)", true), "floor(t/a):0;t < b:1;");
  EXPECT_EQ(switches_in("sign(s - a) + (s > a ? 1 : 0)", true), "sign(s - a):;");
}

std::string jumps_of(const std::string& more) {
  const Study study = read_text(kLeastStudy +
                                "parameters: {n: {initial: 2.5, lower: 0, upper: 5}, m: {initial: "
                                "2}, k: {tune: false, initial: 1}}\n" +
                                more);
  std::string found;
  for (const ParameterJump& jump : find_jumps(study, Eigen::Vector2d(2.5, 2.0)))
    found +=
        (jump.parameter < 0 ? "all"
                            : study.parameters[static_cast<std::size_t>(jump.parameter)].name) +
        ": " + jump.text + "; ";
  return found;
}

std::string with_load(const std::string& effort) {
  return "loads: [{joint: crank_joint, effort: \"${" + effort + "}\"}]\n";
}

TEST(ParameterSwitches, CountWhereATunedParameterJumpsWithinItsBounds) {
  EXPECT_EQ(jumps_of(with_load("floor(n)")), "n: floor(n); ");
  EXPECT_EQ(jumps_of(with_load("floor(k) + n")), "") << "k is not tuned";
  EXPECT_EQ(jumps_of(with_load("floor(n/10)")), "") << "0 everywhere";
  EXPECT_EQ(jumps_of(with_load("(n < 2 ? n : 4 - n)")), "") << "the branches meet";
  EXPECT_EQ(jumps_of(with_load("(n < 2 ? n : 5 - n)")), "n: n < 2; ");
  EXPECT_EQ(jumps_of(with_load("(m < 3 ? 1 : 2)*sin(t)")), "m: m < 3; ");
  EXPECT_EQ(jumps_of(with_load("(t < n ? 1 : 2)")), "") << "a run passes it";
  EXPECT_EQ(jumps_of(with_load("floor(n)*crank_joint/velocity")), "n: floor(n); ");
  EXPECT_EQ(jumps_of(with_load("(n < 2 ? n : 4 - n)*crank_joint/velocity")), "");
}

TEST(ParameterSwitches, CountAtInstants) {
  EXPECT_EQ(jumps_of("final: [{signal: \"${floor(crank_joint/position)}\", at_most: 3}]\n"),
            "all: floor(crank_joint/position); ");
  const std::string controller =
      "controllers: {c: {type: pid, input: crank_joint/position, output: crank_joint, gains: {p: "
      "1}, setpoint: \"${t < n/10 ? 0 : 1}\"";
  EXPECT_EQ(jumps_of(controller + "}}\n"), "");
  EXPECT_EQ(jumps_of(controller + ", sample_time: 0.01}}\n"), "n: t < n/10; ");
}

}  // namespace
}  // namespace codesign
