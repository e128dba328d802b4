// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/fields.h"

#include <gtest/gtest.h>

#include "jobs/result_fields.h"

namespace codesign {
namespace {

TEST(Fields, GiveMembersForReadingAndWriting) {
  Statistics statistics;
  statistics.steps = 12;
  const Statistics& same = statistics;
  int rows = 0;
  for_each_field<Statistics>([&](const auto& row) {
    ++rows;
    if (std::string(row.name) == "steps") {
      EXPECT_EQ(static_cast<int>(row.of(same)), 12);
    }
    if (std::string(row.name) == "energy_error") row.of(statistics) = 2;
  });
  EXPECT_EQ(rows, 6);
  EXPECT_EQ(statistics.energy_error, 2.0);
}

TEST(Fields, AWordStandsForABool) {
  const auto direction = word("direction", &Event::rising, "falling", "rising");
  Event event;
  EXPECT_EQ(direction.of(event), "falling");
  event.rising = true;
  EXPECT_EQ(direction.of(event), "rising");
}

}  // namespace
}  // namespace codesign
