// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equations/equation_recorder.h"
#include "equations/equation_variant.h"
#include "equations/joint_cases.h"
#include "equations/loaded_arm.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(RecordPatterns, HaveARowPerEquationAndOneForTheIntegrand) {
  const auto system = servo("{}");
  const ByVariable<Sparsity> patterns = record_patterns(*system, ResidualRecording(*system));
  EXPECT_EQ(patterns.rate.rows, system->layout().columns() + 1);
  EXPECT_EQ(patterns.position.columns, system->layout().positions());
  EXPECT_EQ(patterns.velocity.columns, system->layout().n);
  for (const Sparsity* pattern : {&patterns.position, &patterns.velocity, &patterns.rate}) {
    ASSERT_EQ(pattern->row_start.size(), static_cast<std::size_t>(pattern->rows) + 1);
    for (int row = 0; row < pattern->rows; ++row)
      for (int e = pattern->first(row) + 1; e < pattern->first(row + 1); ++e)
        EXPECT_LT(pattern->column(e - 1), pattern->column(e));
  }
}

/// derive_linearization() throws for an entry outside the patterns; kMotion may leave all
/// derivatives but those by z to kLinearized.
void expect_room(const CompiledSystem& system, const std::vector<bool>& outcomes,
                 const std::vector<bool>& mode, const std::string& of) {
  for (const EquationPart part : {EquationPart::kMotion, EquationPart::kLinearized})
    EXPECT_NO_THROW(system.record_variant(outcomes, part, mode)) << of;
}

/// Each decision alone is turned round.
void expect_room_for_every_variant(const CompiledSystem& system) {
  const std::vector<bool> outcomes = system.equation_variant()->outcomes();
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    std::vector<bool> other(outcomes.begin(),
                            outcomes.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    other.back() = !other.back();
    expect_room(system, other, {}, "decision " + std::to_string(k));
  }
}

TEST(RecordPatterns, HaveRoomForEveryBranch) {
  const std::string stops =
      "limits: {position: true, effort: true, stiffness: 50.0, width: 0.01, dissipation: 0.4}\n";
  expect_room_for_every_variant(*compile(loaded_arm(), "duration: 1.0\n" + stops));
  for (const char* friction : {"lugre", "gonthier"})
    expect_room_for_every_variant(
        *compile(with_friction_model(puck(), friction), "duration: 1.0\n"));
  for (const JointCase& joint : joint_cases::all())
    expect_room_for_every_variant(*compile(joint_cases::model(joint), "duration: 1.0\n" + stops));
  expect_room_for_every_variant(*servo("{}"));
}

/// Which branch of nested ones an expression takes has no bound in their number. The equations of
/// slides in series depend on positions and velocities through their loads alone.
TEST(RecordPatterns, HaveRoomForEveryBranchOfNestedExpressions) {
  const auto slide = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return "<joint name='" + name + "' type='prismatic'><parent link='" + parent +
           "'/><child link='" + child +
           "'/><axis xyz='1 0 0'/><limit effort='0' velocity='0'/></joint>";
  };
  const std::string robot_text =
      robot(bar("a") + slide("j", "ground", "a") + bar("b") + slide("k", "a", "b"));
  for (const char* effort :
       {"max(t, max(j/position, k/position))", "min(max(j/velocity, 1), max(k/position, t))",
        "t > 0.1 ? (t > 0.2 ? (t > 0.3 ? j/position : k/position) : j/velocity) : (t > 0.05 ? "
        "(t > 0.07 ? k/velocity : j/position) : (t > 0.02 ? k/position : k/velocity))",
        "(t > 0.1 ? j/position : 2) * (t > 0.2 ? max(k/position, abs(j/velocity)) : k/velocity)"}) {
    SCOPED_TRACE(effort);
    const auto system = compile(robot_text, "duration: 1.0\nloads: [{joint: k, effort: \"${" +
                                                std::string(effort) + "}\"}]\n");
    constexpr unsigned kModes = 64;
    for (unsigned bits = 0; bits < kModes; ++bits) {
      std::vector<bool> mode;
      for (unsigned k = 1; k < kModes; k *= 2) mode.push_back((bits & k) != 0);
      expect_room(*system, {}, mode, std::to_string(bits));
    }
  }
}

}  // namespace

}  // namespace codesign
