// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/run_jumps.h"

#include <gtest/gtest.h>

#include "integration/driven_slides.h"
#include "sensitivity/hybrid_cases.h"

namespace codesign {
namespace {

/// 2 kg that 6 N push from 0.35 s on, at 1 m/s, and a controller that samples each 0.25 s.
HybridCase pushed_slide() {
  return {"pushed", robot(mass("piston", 2.0) + lift("slide", "piston", 0.0)),
          R"(duration: 1.0
gravity: [0, 0, 0]
initial_state: {slide: {velocity: 1.0}}
parameters: {ts: {initial: 0.35}}
loads: [{joint: slide, effort: "${t < ts ? 0 : 6}"}]
controllers: {c: {type: pid, input: slide/velocity, output: slide, setpoint: 0.0,
  sample_time: 0.25, gains: {p: 0.0}}}
objective: {integral: [{signal: "${t < ts ? 0 : 3}"}]}
)"};
}

TEST(RunJumps, HoldWhatHappenedBetweenSteps) {
  const auto system = pushed_slide().compile("method: rodas4");
  RosenbrockIntegrator run(*system);
  RunJumps jumps;
  std::vector<double> times;
  for (int repetition = 0; repetition < 2; ++repetition) {
    jumps.clear();
    times.clear();
    EXPECT_TRUE(jumps.is_empty());
    EXPECT_TRUE(jumps.mode_after(3).empty());
    ASSERT_TRUE(run.start(system->parameters()).ok());
    while (!run.has_ended()) {
      ASSERT_TRUE(run.jump().ok());
      if (run.has_jumped()) jumps.append(static_cast<int>(times.size()), run);
      ASSERT_TRUE(run.advance(1.0).ok());
      times.push_back(run.step().previous().t);
    }
  }
  int switches = 0, samples = 0;
  double rates = 0.0, integrand = 0.0;
  for (int k = 0; k < static_cast<int>(times.size()); ++k) {
    const RunJump* const jump = jumps.at(k);
    const double time = times[static_cast<std::size_t>(k)];
    if (!jump) {
      EXPECT_EQ(jumps.mode_before(k), jumps.mode_after(k)) << k;
      continue;
    }
    EXPECT_EQ(jump->point, k);
    EXPECT_EQ(jumps.mode_after(k), jump->mode);
    samples += jump->events.empty() ? 0 : 1;
    if (jump->guard < 0) continue;
    ++switches;
    EXPECT_NEAR(time, 0.35, 1e-14);
    EXPECT_NE(jumps.mode_before(k), jumps.mode_after(k));
    EXPECT_NEAR(jump->guard_rate, -1.0, 1e-14) << "of s = ts - t";
    rates += jump->rates[0];
    integrand += jump->integrand_jump;
  }
  // The load's comparison and the objective's, one after the other: f- - f+ and g- - g+.
  EXPECT_EQ(switches, 2);
  EXPECT_NEAR(rates, -3.0, 1e-12);
  EXPECT_NEAR(integrand, -9.0, 1e-12);
  EXPECT_EQ(samples, 3);
  ASSERT_NE(jumps.at(0), nullptr) << "the mode of the start";
  EXPECT_TRUE(jumps.mode_before(0).empty());
}

}  // namespace
}  // namespace codesign
