// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mpi/launcher.h"

#include <gtest/gtest.h>

#include <cstring>

namespace codesign {
namespace {

const char* nothing(const char*) { return nullptr; }
const char* open_mpi(const char* name) {
  return std::strcmp(name, "OMPI_COMM_WORLD_RANK") == 0   ? "3"
         : std::strcmp(name, "OMPI_COMM_WORLD_SIZE") == 0 ? "8"
                                                          : nullptr;
}
const char* pmix(const char* name) { return std::strcmp(name, "PMIX_RANK") == 0 ? "2" : nullptr; }
const char* pmi(const char* name) {
  return std::strcmp(name, "PMI_RANK") == 0   ? "0"
         : std::strcmp(name, "PMI_SIZE") == 0 ? "5"
                                              : nullptr;
}
const char* timeout(const char* name, const char* seconds) {
  return std::strcmp(name, "OMPI_MCA_odls_base_sigkill_timeout") == 0 ? seconds : nullptr;
}
const char* ten_seconds(const char* name) { return timeout(name, "10"); }
const char* no_number(const char* name) { return timeout(name, "soon"); }

TEST(Launcher, IsFoundByItsEnvironment) {
  EXPECT_FALSE(find_launcher(nothing).has_value());
  EXPECT_EQ(find_launcher(open_mpi)->rank, 3);
  EXPECT_EQ(find_launcher(open_mpi)->ranks, 8);
  EXPECT_EQ(find_launcher(pmix)->rank, 2);
  EXPECT_EQ(find_launcher(pmix)->ranks, 0) << "it does not say";
  EXPECT_EQ(find_launcher(pmi)->ranks, 5);
}

TEST(Launcher, TellsHowLongRanksLiveAfterALoss) {
  EXPECT_FALSE(seconds_to_end(nothing).has_value());
  EXPECT_EQ(seconds_to_end(ten_seconds), 10.0);
  EXPECT_FALSE(seconds_to_end(no_number).has_value());
}

}  // namespace
}  // namespace codesign
