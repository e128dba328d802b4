// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Loops as CAD programs write them, with angles and lengths rounded.
#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled.h"
#include "equations/compiled_system.h"
#include "integration/rounded_linkages.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A planar four-bar, in a plane that is tilted against all axes, with friction in a hinge whose
/// moments across the plane nothing determines.
std::string tilted_four_bar(const std::string& rounding, const std::string& offset = "0") {
  const auto link = [](const std::string& name, double length) {
    return "<link name='" + name + "'><inertial><origin xyz='" + to_decimal(0.5 * length) +
           " 0 0.02'/><mass value='1'/><inertia ixx='0.001' ixy='0' ixz='0' iyy='0.01' iyz='0' "
           "izz='0.01'/></inertial></link>";
  };
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& origin,
                        const std::string& more = "") {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='0 0 1'/>" + more +
           "</joint>";
  };
  const std::string friction =
      "<codesign:friction mu_static='0.24' codesign:mu_static='${1.2*mu}' mu_dynamic='0.2' "
      "codesign:mu_dynamic='${mu}' joint_length='0.05' "
      "pin_radius='0.02'/>";
  return "<robot name='four' xmlns:codesign='urn:test'><codesign:parameter name='mu' value='0.2' "
         "lower='0' upper='0.5'/><link "
         "name='ground'/>"
         "<link name='frame'/><joint name='tilt' type='fixed'><parent link='ground'/><child "
         "link='frame'/><origin rpy='0.3 0.4 "
         "0.2'/></joint>" +
         link("crank", 0.1) + link("coupler", 0.35) + link("rocker", 0.25) +
         hinge("j1", "frame", "crank", "xyz='0 0 0'", friction) +
         hinge("j2", "crank", "coupler", "xyz='0.1 0 0'") +
         hinge("j3", "frame", "rocker", "xyz='0.3 0 " + offset + "'") +
         "<loop name='closure' type='revolute'><predecessor link='coupler'><origin xyz='0.35 0 0' "
         "rpy='" +
         rounding +
         "'/></predecessor><successor link='rocker'><origin xyz='0.25 0 0'/></successor><axis "
         "xyz='0 0 1'/></loop></robot>";
}

std::string study(double tolerance, const std::string& more = "") {
  return "duration: 0.2\ngravity: [0, -9.81, 0]\nparameters: {mu: {}}\ninitial_state: {j1: "
         "{position: 0.5, velocity: 1.0}, j3: {guess: "
         "1.5}}\nsolver: {relative_tolerance: " +
         to_decimal(tolerance) + ", absolute_tolerance: " + to_decimal(tolerance) + more +
         "}\nobjective: {integral: [{signal: j1/velocity}]}\n";
}

Evaluation evaluate(const std::string& urdf, double tolerance, const std::string& more = "") {
  const Problem problem =
      load_problem({"four.urdf", urdf}, {}, {"four.yaml", study(tolerance, more)});
  Evaluator evaluator(problem);
  return evaluator.evaluate(problem.start(), true);
}

TEST(RoundedLoops, RoundingInTheLastDigitChangesNothing) {
  for (double tolerance : {1e-6, 1e-8, 1e-10}) {
    const Evaluation exact = evaluate(tilted_four_bar("0 0 0"), tolerance),
                     rounded = evaluate(tilted_four_bar("1e-16 2e-16 0"), tolerance);
    ASSERT_TRUE(exact.status.ok() && rounded.status.ok());
    EXPECT_NEAR(rounded.objective, exact.objective, 1e-8 * exact.objective) << tolerance;
    EXPECT_NEAR(rounded.gradient[0], exact.gradient[0], 1e-6 * std::abs(exact.gradient[0]))
        << tolerance;
  }
}

TEST(RoundedLoops, ResultsAreContinuousInTheRounding) {
  const Evaluation exact = evaluate(tilted_four_bar("0 0 0"), 1e-8);
  for (double rounding : {1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-4}) {
    const Evaluation rounded = evaluate(
        tilted_four_bar(to_decimal(rounding) + " " + to_decimal(-2.0 * rounding) + " 0"), 1e-8);
    ASSERT_TRUE(rounded.status.ok()) << rounding << rounded.status.cause;
    EXPECT_NEAR(rounded.objective, exact.objective, (20.0 * rounding + 1e-9) * exact.objective)
        << rounding;
  }
}

TEST(RoundedLoops, ObjectiveAndGradientSettleAsTheToleranceFalls) {
  const std::string urdf = tilted_four_bar("0.00001 -0.00002 0", "0.00003");
  const Evaluation tight = evaluate(urdf, 1e-11), loose = evaluate(urdf, 1e-8);
  ASSERT_TRUE(tight.status.ok() && loose.status.ok());
  EXPECT_NEAR(loose.objective, tight.objective, 1e-7 * tight.objective);
  EXPECT_NEAR(loose.gradient[0], tight.gradient[0], 1e-6 * std::abs(tight.gradient[0]));
}

struct RoundedCase {
  const char* name;
  std::string urdf, start, signal;
};

TEST(RoundedLoops, OtherLinkagesSettleAsTheToleranceFalls) {
  for (const RoundedCase& c :
       {RoundedCase{"two four-bars", rounded::two_four_bars(), rounded::two_four_bars_start(),
                    "j1_a/velocity + j1_b/velocity"},
        {"three cranks", rounded::three_cranks(), rounded::three_cranks_start(), "j0/velocity"},
        {"Bennett's ring", rounded::bennett(), rounded::bennett_start(), "t1/velocity"},
        {"parallel arms", rounded::parallel_arms(), rounded::parallel_arms_start(),
         "m1/velocity"}}) {
    const auto at = [&c](double tolerance) {
      const Problem problem =
          load_problem({"rounded.urdf", c.urdf}, {},
                       {"rounded.yaml", rounded::study(c.start, c.signal, 0.2, tolerance)});
      EXPECT_FALSE(system_of(problem)->sharing().dropped.empty()) << c.name;
      return Evaluator(problem).evaluate(problem.start(), true);
    };
    const Evaluation tight = at(1e-11);
    ASSERT_TRUE(tight.status.ok()) << c.name << ": " << tight.status.cause;
    const double size = std::max(std::abs(tight.objective), std::abs(tight.gradient[0]));
    for (double tolerance : {1e-6, 1e-8}) {
      const Evaluation loose = at(tolerance);
      ASSERT_TRUE(loose.status.ok()) << c.name << ": " << loose.status.cause;
      EXPECT_NEAR(loose.objective, tight.objective, 5.0 * tolerance * size)
          << c.name << " at " << tolerance;
      EXPECT_NEAR(loose.gradient[0], tight.gradient[0], 5.0 * tolerance * size)
          << c.name << " at " << tolerance;
    }
  }
}

TEST(RoundedLoops, AMissIsAWarningAndTooMuchIsRefused) {
  const Problem exact =
      load_problem({"four.urdf", tilted_four_bar("0 0 0")}, {}, {"four.yaml", study(1e-6)});
  ASSERT_EQ(exact.warnings().size(), 1U);
  EXPECT_EQ(exact.warnings()[0].code, "undetermined_friction");
  EXPECT_NE(exact.warnings()[0].message.find("j1"), std::string::npos);
  const Problem near =
      load_problem({"four.urdf", tilted_four_bar("0.0002 0 0")}, {}, {"four.yaml", study(1e-6)});
  ASSERT_EQ(near.warnings().size(), 2U);
  EXPECT_EQ(near.warnings()[0].code, "inexact_loop");
  EXPECT_NE(near.warnings()[0].message.find("closure"), std::string::npos);
  const std::string apart = tilted_four_bar("0 0 0", "0.004");
  try {
    load_problem({"four.urdf", apart}, {}, {"four.yaml", study(1e-6)});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "<loop name=\"closure\">");
    EXPECT_NE(error.fault().value.find("mm and"), std::string::npos);
  }
  EXPECT_NO_THROW(load_problem({"four.urdf", apart}, {},
                               {"four.yaml", study(1e-6, ", closure_tolerance: 0.01")}));
}

}  // namespace
}  // namespace codesign
