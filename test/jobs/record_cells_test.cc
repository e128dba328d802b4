// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/record_cells.h"

#include <gtest/gtest.h>

#include "jobs/result_fields.h"

namespace codesign {
namespace {

using Texts = std::vector<std::string>;

TEST(RecordCells, AreTheFieldsOfAResult) {
  EXPECT_EQ(columns_of<StartResult>(), (Texts{"start_objective", "objective", "status",
                                              "termination", "evaluations", "optimum"}));
  const StartResult search{{}, {}, 9.0, 0.1, {}, "success", 12, 0};
  EXPECT_EQ(cells_of(search), (Texts{"9", "0.1", "success", "success", "12", "1"}));
  const ScenarioResult scenario{"light", -1, 0.5, {}, 3.0, 2.0, "lugre", false, true};
  EXPECT_EQ(cells_of(scenario), (Texts{"light", "0", "0.5", "3", "2", "0", "1", "lugre"}));
}

}  // namespace
}  // namespace codesign
