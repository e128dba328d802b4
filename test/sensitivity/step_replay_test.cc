// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/step_replay.h"

#include <gtest/gtest.h>

#include "sensitivity/hybrid_cases.h"

namespace codesign {
namespace {

/// A step of a run: where the last one ended, before and behind a jump, and where this one ends.
struct Recorded {
  State<double> point, before, behind, end;
  bool has_jump;
};

void expect_near(const State<double>& a, const State<double>& b, const char* what, int k) {
  EXPECT_EQ(a.t, b.t) << what << " " << k;
  for (const auto& [x, y] : {std::pair{&a.q, &b.q}, {&a.v, &b.v}, {&a.s, &b.s}})
    EXPECT_LE((*x - *y).norm(), 1e-9 * (1.0 + y->norm())) << what << " " << k;
  // Reactions of redundant rows are known to rounding over the compliance.
  EXPECT_LE((a.z - b.z).norm(), 1e-6 * (1.0 + b.z.norm())) << what << " " << k;
}

class StepReplayTest : public ::testing::TestWithParam<int> {};

// With few stored points the steps between them are computed again, over the same jumps.
TEST_P(StepReplayTest, RepeatsStepsAndJumpsBackwards) {
  for (const HybridCase& test : hybrid_cases()) {
    const auto system = test.compile("method: auto");
    RosenbrockIntegrator run(*system);
    std::vector<Recorded> steps;
    ASSERT_TRUE(run.start(system->parameters()).ok());
    StepReplay replay(*system, run.step().tableau(), GetParam());
    replay.start(run);
    State<double> point = run.initial_state();
    while (!run.has_ended()) {
      const State<double> before = run.state();
      ASSERT_TRUE(run.jump().ok());
      const bool has_jump = run.has_jumped();
      if (has_jump) replay.store_jump(run);
      const State<double> behind = run.state();
      ASSERT_TRUE(run.advance(run.end()).ok());
      replay.store_step(run);
      steps.push_back({point, before, behind, run.step().unprojected(), has_jump});
      point = run.step().unprojected();
    }
    ASSERT_EQ(replay.size(), static_cast<int>(steps.size()) + 1);
    replay.begin(&run);
    ASSERT_TRUE(replay.repeat(replay.size() - 1, nullptr));
    expect_near(replay.point(), point, "the end", replay.size() - 1);
    for (int k = replay.size() - 1; k-- > 0;) {
      const Recorded& step = steps[static_cast<std::size_t>(k)];
      ASSERT_TRUE(replay.repeat(k, nullptr)) << test.name;
      expect_near(replay.point(), step.point, "point", k);
      expect_near(replay.step().unprojected(), step.end, "end of step", k);
      ASSERT_EQ(replay.jump(k) != nullptr, step.has_jump);
      if (!step.has_jump) continue;
      if (k > 0) expect_near(replay.before(), step.before, "before jump", k);
      expect_near(replay.behind(), step.behind, "behind jump", k);
    }
    const std::atomic<bool> cancel{true};
    EXPECT_TRUE(GetParam() == 0 || !replay.repeat(replay.size() - 1, &cancel)) << test.name;
  }
}

INSTANTIATE_TEST_SUITE_P(MostPoints, StepReplayTest, ::testing::Values(0, 4));

}  // namespace
}  // namespace codesign
