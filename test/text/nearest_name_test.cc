// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ctime>

#include "text/nearest_name.h"

namespace codesign {
namespace {

TEST(NearestName, FindsInsertedDroppedReplacedAndSwappedLetters) {
  const std::vector<std::string> known = {"duration", "crank_length", "rod_length"};
  EXPECT_EQ(nearest_name("duratiion", known), "duration");
  EXPECT_EQ(nearest_name("duraton", known), "duration");
  EXPECT_EQ(nearest_name("duretion", known), "duration");
  EXPECT_EQ(nearest_name("crank_lenght", known), "crank_length");
  EXPECT_EQ(nearest_name("Crank_Length", known), "crank_length");
}

TEST(NearestName, TakesTheNearestOfSeveral) {
  EXPECT_EQ(nearest_name("joint_2x", {"joint_1", "joint_2", "joint_3"}), "joint_2");
  EXPECT_EQ(nearest_name("ba", {"bac", "ab", "ba_"}), "bac");
}

TEST(NearestName, GivesNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("banana", {"duration", "objective"}), "");
  EXPECT_EQ(nearest_name("x", {"y", "z"}), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

TEST(NearestName, DoesNotCompareEveryPairOfLetters) {
  std::vector<std::string> many;
  for (int k = 0; k < 300000; ++k) many.push_back("coefficient_" + std::to_string(k));
  const std::string huge(1000000, 'a');
  const std::clock_t begin = std::clock();
  EXPECT_EQ(nearest_name("coeficient_7", many), "coefficient_7");
  EXPECT_EQ(nearest_name(huge, {huge + "b"}), "");
  EXPECT_EQ(nearest_name("short", {huge}), "");
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 60.0)
      << "comparing every pair of letters takes hours";
}

TEST(NearestName, IsOfferedAsAQuestion) {
  EXPECT_EQ(did_you_mean("crank_joint"), ", did you mean \"crank_joint\"?");
  EXPECT_EQ(did_you_mean(""), "");
}

TEST(UnknownName, SaysWhatWasMeant) {
  const InputError error =
      unknown_name({"study.yaml", 3}, "solver.metod", "key", "metod", {"method", "integrator"});
  EXPECT_STREQ(error.what(),
               "study.yaml:3: solver.metod: unknown key, did you mean \"method\"? (value: metod, "
               "allowed: method, integrator)");
}

TEST(UnknownName, GuessesNothingFromAfar) {
  EXPECT_EQ(unknown_name({"f", 1}, "e", "joint", "banana", {"crank_joint"}).fault().message,
            "unknown joint");
}

TEST(UnknownName, ListsAtMostTwoDozenNames) {
  EXPECT_EQ(list_names({}), "there are none");
  EXPECT_EQ(list_names({"a", "b"}), "a, b");
  const std::string list = list_names(std::vector<std::string>(30, "n"));
  EXPECT_EQ(list.substr(list.size() - 9), "n, n, ...") << list;
}

}  // namespace

}  // namespace codesign
