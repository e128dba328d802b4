// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/isolation.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

namespace codesign::fuzz {
namespace {

const Limits kShort{0.1, 0.1, 0};

std::string found(const Body& body, const Limits& limits = kShort) {
  return run_isolated(body, limits);
}

void expect_found(const std::string& fault, const std::string& part) {
  EXPECT_NE(fault.find(part), std::string::npos) << fault;
}

TEST(Isolation, PassesOnWhatTheBodySays) {
  EXPECT_EQ(found([](const auto&) { return ""; }), "");
  EXPECT_EQ(found([](const auto&) { return "wrong"; }), "wrong");
}

TEST(Isolation, FindsCrashesAndExceptions) {
  expect_found(found([](const auto&) -> std::string { std::abort(); }), "killed by a signal");
  expect_found(found([](const auto&) -> std::string { throw std::runtime_error("lost"); }),
               "an exception got out: lost");
  expect_found(found([](const auto&) -> std::string { std::_Exit(0); }), "left with exit code 0");
}

TEST(Isolation, FindsWhatDoesNotObeyOrNeverEnds) {
  EXPECT_EQ(found([](const std::atomic<bool>& cancel) {
              while (!cancel) continue;
              return "";
            }),
            "");
  const auto late = [](const std::atomic<bool>&) {
    for (const std::clock_t begin = std::clock(); std::clock() - begin < CLOCKS_PER_SEC;) continue;
    return "";
  };
  expect_found(found(late), "did not obey a cancel");
  volatile bool forever = true;
  expect_found(found([&forever](const std::atomic<bool>&) {
                 while (forever) continue;
                 return "";
               }),
               "never ends");
}

TEST(Isolation, FindsMemory) {
  const auto hungry = [](const std::atomic<bool>&) {
    const std::vector<char> memory(200000000, 'x');
    return memory.back() == 'x' ? "" : "no";
  };
  expect_found(found(hungry, {5.0, 1.0, 100000}), "kB of memory");
  EXPECT_EQ(found(hungry, {5.0, 1.0, 0}), "");
}

}  // namespace
}  // namespace codesign::fuzz
