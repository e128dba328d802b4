// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/design_branch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/assembly.h"
#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

constexpr double kSoft = 1e-9;  // compliance of redundant rows

/// A planar crank-rocker whose lengths are parameters; the crank's position is given.
std::string crank_rocker() {
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><origin xyz='0.05 0 0'/><mass value='1'/><inertia ixx='0.001' ixy='0' "
           "ixz='0' iyy='0.01' iyz='0' izz='0.01'/>"
           "</inertial></link>";
  };
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& origin) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='0 0 1'/></joint>";
  };
  return "<robot name='four' xmlns:codesign='urn:t'><codesign:parameter name='a' "
         "value='0.08'/><codesign:parameter name='b' value='0.25'/>"
         "<codesign:parameter name='c' value='0.3'/><codesign:parameter name='d' "
         "value='0.3'/><link name='ground'/>" +
         link("crank") + link("coupler") + link("rocker") +
         hinge("crank_pin", "ground", "crank", "xyz='0 0 0'") +
         hinge("coupler_pin", "crank", "coupler", "xyz='0.08 0 0' codesign:xyz='${a} 0 0'") +
         hinge("rocker_pin", "ground", "rocker", "xyz='0.3 0 0' codesign:xyz='${d} 0 0'") +
         "<loop name='end_pin' type='revolute'><predecessor link='coupler'><origin xyz='0.25 0 0' "
         "codesign:xyz='${b} 0 0'/></predecessor>"
         "<successor link='rocker'><origin xyz='0.3 0 0' codesign:xyz='${c} 0 "
         "0'/></successor><axis xyz='0 0 1'/></loop></robot>";
}

std::string crank_at(double position, double coupler, double rocker) {
  return let_go("{crank_pin: {position: " + std::to_string(position) +
                    "}, coupler_pin: {guess: " + std::to_string(coupler) +
                    "}, rocker_pin: {guess: " + std::to_string(rocker) + "}}",
                "rocker_pin/velocity", "parameters: {a: {}, b: {}, c: {}, d: {}}\n");
}

/// The design at `way` between the model's (0) and a smaller linkage (1).
std::vector<double> design_at(double way) {
  return {0.08 + way * 0.01, 0.25 - way * 0.12, 0.3 - way * 0.19, 0.3 - way * 0.16};
}

/// The joints' positions along the way, as far as the loop can be closed.
std::vector<Eigen::VectorXd> along_the_way(Compiled* c, int steps, bool from_the_end = false) {
  std::vector<Eigen::VectorXd> positions;
  EXPECT_TRUE(c->start().ok());
  for (int k = 0; k <= steps; ++k) {
    const double way = static_cast<double>(from_the_end ? steps - k : k) / steps;
    if (c->start(design_at(way)).ok()) positions.push_back(c->assembly.theta());
  }
  return positions;
}

TEST(DesignBranch, PositionsAreContinuousInTheDesign) {
  int jumps_without = 0;
  for (int k = 0; k < 12; ++k) {
    const double crank = 0.5235987755982988 * k;
    Compiled c(crank_rocker(), crank_at(crank, 1.0, 1.5), kSoft);
    const std::vector<Eigen::VectorXd> positions = along_the_way(&c, 100);
    EXPECT_EQ(positions.size(), 101U) << k;
    for (std::size_t i = 1; i < positions.size(); ++i) {
      const double step = (positions[i] - positions[i - 1]).cwiseAbs().maxCoeff();
      EXPECT_LT(step, 0.15) << "crank " << k << ", step " << i;
    }
    if (!c.assembly.warnings().empty()) {
      ++jumps_without;
      EXPECT_EQ(c.assembly.warnings()[0].code, "branch_continued");
      for (const char* part :
           {"end_pin", "initial_state: {", "rocker_pin: {guess: ", "a = 0.09, b = 0.13"})
        EXPECT_NE(c.assembly.warnings()[0].message.find(part), std::string::npos)
            << c.assembly.warnings()[0].message;
    }
  }
  EXPECT_GT(jumps_without, 0) << "the study's guesses alone lead elsewhere";
}

TEST(DesignBranch, ThePositionDoesNotDependOnDesignsSolvedBefore) {
  Compiled forward(crank_rocker(), crank_at(2.0943951, 1.0, 1.5), kSoft),
      backward(crank_rocker(), crank_at(2.0943951, 1.0, 1.5), kSoft);
  std::vector<Eigen::VectorXd> there = along_the_way(&forward, 20),
                               back = along_the_way(&backward, 20, true);
  ASSERT_EQ(there.size(), back.size());
  std::reverse(back.begin(), back.end());
  for (std::size_t k = 0; k < there.size(); ++k)
    EXPECT_EQ(there[k], back[k]) << "to the last bit, " << k;
}

TEST(DesignBranch, TheGuessesOfTheWarningLeadToThePosition) {
  for (int k = 0; k < 12; ++k) {
    const double crank = 0.5235987755982988 * k;
    Compiled c(crank_rocker(), crank_at(crank, 1.0, 1.5), kSoft);
    ASSERT_TRUE(c.start().ok());
    ASSERT_TRUE(c.start(design_at(1.0)).ok());
    if (c.assembly.warnings().empty()) continue;
    const Eigen::VectorXd theta = c.assembly.theta();
    Compiled alone(crank_rocker(), crank_at(crank, theta[1], theta[2]), kSoft);
    ASSERT_TRUE(alone.start(design_at(1.0)).ok());  // first, so that nothing is continued
    EXPECT_LT((alone.assembly.theta() - theta).cwiseAbs().maxCoeff(), 1e-9) << k;
    EXPECT_TRUE(alone.assembly.warnings().empty());
  }
}

TEST(DesignBranch, WhereTheLoopOpensOnTheWayTheWarningSaysSo) {
  // A crank as long as this does not turn fully at the model's design: on the way from b = 0.25 to
  // 0.7 the loop cannot be closed at 0.5.
  Compiled c(crank_rocker(), crank_at(3.1, 1.0, 1.5), kSoft);
  ASSERT_TRUE(c.start().ok());
  EXPECT_FALSE(c.start({0.08, 0.75, 0.3, 0.3}).ok());
  ASSERT_TRUE(c.start({0.08, 0.75, 0.3, -0.9}).ok());
  ASSERT_EQ(c.assembly.warnings().size(), 1U);
  EXPECT_EQ(c.assembly.warnings()[0].code, "branch_lost");
  for (const char* part : {"end_pin", "guess: ", "b = 0.75", "d = -0.9"})
    EXPECT_NE(c.assembly.warnings()[0].message.find(part), std::string::npos)
        << c.assembly.warnings()[0].message;
}

TEST(DesignBranch, KeepsAPostureThatIsItsOwnContinuationToTheLastBit) {
  LoopsToClose c(triangle());
  LoopNewton newton(c.loops);
  const std::vector<double> longer{1.2};
  DesignBranch branch(c.loops, c.design.parameters, &newton);
  EXPECT_FALSE(branch.is_known());
  Posture own = c.at({-std::asin(0.6), std::asin(0.6)});
  own.dependent = own.moved = {0, 1};
  branch.begin(own);
  EXPECT_TRUE(branch.is_known());
  // The two positions of the longer bar; the own one lies below.
  const double inner = std::acos((1.0 + 1.44 - 1.44) / 2.4),
               other = std::acos((1.44 + 1.44 - 1.0) / 2.88);
  const std::vector<double> below{inner - 0.5 * M_PI, 0.5 * M_PI - other},
      above{-inner - 0.5 * M_PI, 0.5 * M_PI + other};
  c.compiled.equations.set_design(longer);
  for (const bool is_own : {true, false}) {
    Posture found = c.at(is_own ? below : above);
    found.rate << 1.0, 2.0;
    const Posture before = found;
    Warnings warnings;
    EXPECT_TRUE(branch.keep({}, c.design.at(longer), &found, &warnings).ok());
    EXPECT_EQ(c.compiled.equations.parameters(), longer);
    EXPECT_EQ(found.rate, before.rate);
    EXPECT_EQ(warnings.size(), is_own ? 0U : 1U);
    EXPECT_NEAR(found.theta[0], below[0], 1e-12);
    if (is_own) {
      EXPECT_EQ(found.theta, before.theta);
    }
  }
}

TEST(DesignBranch, IsNotKnownWhereAllCoordinatesHadToMove) {
  LoopsToClose c(triangle());
  LoopNewton newton(c.loops);
  DesignBranch branch(c.loops, c.design.parameters, &newton);
  Posture own = c.at({-std::asin(0.6), std::asin(0.6)});
  own.dependent = {0};
  own.moved = {0, 1};
  branch.begin(own);
  EXPECT_FALSE(branch.is_known());
}

}  // namespace
}  // namespace codesign
