// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include "edited_text.h"
#include "equations/compiled_system.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "integration/mechanisms.h"

namespace codesign {
namespace {

/// A slide and hinges, one of them folded with another, all with narrow limits and overdriven
/// servos.
std::string bounded() {
  const std::string narrow = "<limit lower='-0.05' upper='0.04' effort='2' velocity='1'/>";
  const auto joint = [&narrow](const std::string& name, const std::string& type,
                               const std::string& parent, const std::string& child,
                               const std::string& axis) {
    return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
           "'/><child link='" + child + "'/><axis xyz='" + axis + "'/>" + narrow + "</joint>";
  };
  return robot(bar("cart") + bar("arm") + "<link name='fork'/>" + bar("tip") +
               joint("slide", "prismatic", "ground", "cart", "1 0 0") +
               joint("hinge", "revolute", "cart", "arm", "0 1 0") +
               joint("yaw", "revolute", "arm", "fork", "0 0 1") +
               joint("roll", "revolute", "fork", "tip", "1 0 0"));
}

std::string study(const std::string& limits) {
  return "duration: 1.0\ncontrollers:\n"
         "  push: {type: pid, input: slide/position, setpoint: 3.0, output: slide, gains: {p: 5.0, "
         "i: 1.0}}\n"
         "  turn: {type: pid, input: hinge/position - roll/velocity, setpoint: 0.3, output: hinge, "
         "gains: {p: 3.0, d: 0.5}}\n"
         "objective: {integral: [{signal: slide/effort - hinge/effort}, {signal: "
         "roll/position}]}\nlimits: " +
         limits + "\n";
}

std::size_t stops(const CompiledSystem& system) {
  std::size_t count = 0;
  for (const JointLoad& load : system.loads()) count += load.find<StopLoad>() ? 1 : 0;
  return count;
}

class EquationsLimitsTest : public ::testing::TestWithParam<std::string>, public EquationsFixture {
 protected:
  EquationsLimitsTest() : EquationsFixture(bounded(), study(GetParam())) {}
};

TEST_P(EquationsLimitsTest, EveryDerivativeIsExact) {
  // The state is beyond every limit, if the study enforces any.
  expect_exact_derivatives(1e-10);
}

TEST(EquationsLimits, EveryDerivativeIsExactWithinThem) {
  EquationsFixture f(
      bounded(),
      replaced_all(
          study("{effort: true, position: true, stiffness: 20.0, dissipation: 0.3, width: 0.01}"),
          "setpoint: [0-9.]*", "setpoint: 0.1"));
  for (VectorX<double>* x : {&f.state.q, &f.state.v, &f.state.s}) *x *= 0.01;
  for (int b = 0; b < f.system.layout().bodies; ++b) f.state.q[kBodySize * b + 3] = 1.0;
  f.expect_exact_derivatives(1e-10);
}

INSTANTIATE_TEST_SUITE_P(
    Limits, EquationsLimitsTest,
    ::testing::Values(
        "{}", "{effort: true}", "{position: true, stiffness: 20.0, width: 0.3}",
        "{effort: true, position: true, stiffness: 20.0, dissipation: 0.3, width: 0.01}"));

TEST(EquationsLimits, BoundWhatTheStudySays) {
  const EquationsFixture off(bounded(), study("{}")),
      on(bounded(), study("{effort: true, position: true}"));
  EXPECT_EQ(stops(off.system), 0U);
  EXPECT_EQ(stops(on.system), 4U);
  int driven = 0;
  for (const JointLoad& load : on.system.loads()) {
    const auto* effort = load.find<ControllerEffort>();
    EXPECT_TRUE(!effort || effort->saturated);
    driven += effort ? 1 : 0;
  }
  EXPECT_EQ(driven, 2);
}

TEST(EquationsLimits, TheEffortIsTheDemandSaturated) {
  EquationsFixture f(bounded(), study("{effort: true}"));
  f.real.formulas().load(f.state);
  const double demand = f.real.formulas().controller_output(0);
  EXPECT_NEAR(f.real.formulas().effort(0, 0),
              demand / std::pow(1.0 + std::pow(demand / 2.0, 8), 0.125), 1e-12);
}

}  // namespace
}  // namespace codesign
