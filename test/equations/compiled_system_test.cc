// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/compiled_system.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "codegen/value_code.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(CompiledSystem, HasOneCodeForAllThreads) {
  const auto system = servo("{}");
  std::vector<const EquationVariant*> found(4);
  std::vector<std::thread> threads;
  for (const EquationVariant*& code : found)
    threads.emplace_back([&code, &system] { code = system->equation_variant(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::set<const EquationVariant*>(found.begin(), found.end()).size(), 1U);
  EXPECT_NE(found[0], nullptr);
}

TEST(CompiledSystem, IsTheSystemWithItsPatterns) {
  const auto system = servo("{}");
  const System copy(system->robot(), system->whole_study(), system->sharing());
  EXPECT_EQ(copy.layout().columns(), system->layout().columns());
  EXPECT_EQ(copy.layout().initial_turns, system->layout().initial_turns);
  EXPECT_GT(system->patterns().rate.nonzeros(), system->layout().columns());
}

TEST(CompiledSystem, KnowsTheModesThatEndARun) {
  const std::string study = "duration: 1.0\n";
  EXPECT_FALSE(compile(pendulum(), study)->ends_run({}));
  const auto system =
      compile(pendulum(), study + "until: \"${hinge/position > 0.2 and not t <= 0.5}\"\n");
  ASSERT_TRUE(system->has_switches());
  for (const bool is_turned : {false, true})
    for (const bool is_late : {false, true})
      EXPECT_EQ(system->ends_run({is_turned, is_late}), is_turned && is_late);
}

}  // namespace
}  // namespace codesign
