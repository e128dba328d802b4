// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace codesign::cli {
namespace {

TEST(Interrupt, EndsTheProgramAtOnceAsLongAsThereIsNothingToKeep) {
  EXPECT_EXIT(
      {
        watch_interrupts();
        std::raise(SIGINT);
      },
      testing::ExitedWithCode(1), "interrupted before anything was computed");
}

TEST(Interrupt, TheFirstSetsTheFlagAndTheSecondEndsTheProgram) {
  EXPECT_FALSE(interrupted());
  watch_interrupts();
  keep_results();
  std::raise(SIGINT);
  EXPECT_TRUE(interrupted());
  EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

TEST(Interrupt, ALimitOfFileSizesIsLeftToTheWrite) {
  EXPECT_EXIT(
      {
        watch_interrupts();
        std::raise(SIGXFSZ);
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace codesign::cli
