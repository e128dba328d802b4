// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/start_positions.h"

#include <gtest/gtest.h>

#include <atomic>

#include "assembly/assembly.h"
#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

constexpr double kSoft = 1e-9;  // compliance of redundant rows

TEST(StartPositions, AStretchedLinkageBendsByItself) {
  Compiled c(stretched_bars(), let_go("{}", "h1/velocity"), kSoft);
  ASSERT_TRUE(c.start().ok());
  ASSERT_EQ(c.assembly.warnings().size(), 1U);
  EXPECT_EQ(c.assembly.warnings()[0].code, "guessed_start");
  EXPECT_NE(c.assembly.warnings()[0].message.find("h1: {guess: 0.01}"), std::string::npos)
      << c.assembly.warnings()[0].message;
  EXPECT_LT(c.assembly.worst_miss().length, 1e-11);
  const Eigen::VectorXd theta = c.assembly.theta();
  ASSERT_TRUE(c.start().ok());
  EXPECT_EQ(c.assembly.theta(), theta);
  // With the guesses that the warning shows there is none.
  Compiled guessed(
      stretched_bars(),
      let_go("{h1: {guess: 0.01}, h2: {guess: 0.01}, h3: {guess: 0.01}}", "h1/velocity"), kSoft);
  ASSERT_TRUE(guessed.start().ok());
  EXPECT_TRUE(guessed.assembly.warnings().empty());
  EXPECT_LT((guessed.assembly.theta() - theta).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(StartPositions, NudgeTheStudysOwnStartOnce) {
  LoopsToClose c(stretched_bars());
  LoopClosure closure(c.loops);
  StartPositions positions(c.loops, &closure);
  FirstPosture first(c.loops);
  Posture posture = c.at({0.0, 0.0, 0.0});
  Warnings warnings;
  ASSERT_TRUE(positions.find(c.design, &first, &posture, &warnings).ok());
  EXPECT_EQ(warnings.size(), 1U);
  EXPECT_EQ(first.nudge(), Eigen::Vector3d(0.01, 0.01, 0.01));
  // A start from given coordinates is not the study's, and bends only if these do.
  FirstPosture other(c.loops);
  other.begin_at(0.0, Eigen::Vector3d::Zero());
  posture = c.at({0.0, 0.0, 0.0});
  const Status status = positions.find(c.design, &other, &posture, &warnings);
  EXPECT_EQ(status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(status.cause.find("'end'"), std::string::npos) << status.cause;
  EXPECT_EQ(other.nudge().size(), 0);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(StartPositions, SolveTheEnforcedRowsInTheEnd) {
  // The tips cannot meet by 0.5 mm along x, which counts as closed, and that row is dropped.
  ReactionSharing sharing;
  sharing.compliance = kSoft;
  sharing.pairs = {2};
  sharing.dropped = {{2, -1, 0}};
  LoopsToClose c(triangle("2.0005"), "{}", sharing);
  LoopClosure closure(c.loops);
  StartPositions positions(c.loops, &closure);
  FirstPosture first(c.loops);
  Posture posture = c.at({-1.5, 1.4});
  Warnings warnings;
  ASSERT_TRUE(positions.find(c.design, &first, &posture, &warnings).ok());
  EXPECT_NEAR(posture.miss.length, 5e-4, 1e-5);
  EXPECT_NEAR(std::cos(posture.theta[0]), std::cos(posture.theta[1]), 1e-14) << "along z";
}

TEST(StartPositions, EndWhenTheyAreCancelled) {
  LoopsToClose c(triangle());
  LoopClosure closure(c.loops);
  StartPositions positions(c.loops, &closure);
  FirstPosture first(c.loops);
  Posture posture = c.at({-0.5, 0.5});
  const std::atomic<bool> cancel{true};
  Warnings warnings;
  EXPECT_EQ(
      positions
          .find({c.design.parameters, c.design.equations, &cancel}, &first, &posture, &warnings)
          .code,
      StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
