// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/unknown_name.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(UnknownName, SaysWhatWasMeant) {
  const InputError error = unknown_name({"study.yaml", 3}, "solver.metod", "key", "metod", {"method", "integrator"});
  EXPECT_STREQ(error.what(),
               "study.yaml:3: solver.metod: unknown key, did you mean \"method\"? (value: metod, allowed: method, integrator)");
}

TEST(UnknownName, GuessesNothingFromAfar) {
  EXPECT_EQ(unknown_name({"f", 1}, "e", "joint", "banana", {"crank_joint"}).fault().message, "unknown joint");
}

TEST(UnknownName, ListsAtMostTwoDozenNames) {
  EXPECT_EQ(list_names({}), "there are none");
  EXPECT_EQ(list_names({"a", "b"}), "a, b");
  const std::string list = list_names(std::vector<std::string>(30, "n"));
  EXPECT_EQ(list.substr(list.size() - 9), "n, n, ...") << list;
}

}  // namespace
}  // namespace codesign
