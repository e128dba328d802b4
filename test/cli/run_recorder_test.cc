// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/run_recorder.h"

#include <gtest/gtest.h>

#include "cli/inputs.h"
#include "cli/run_fixture.h"

namespace codesign::cli {
namespace {

Problem short_problem(const ScratchFolder& folder) {
  Arguments arguments;
  arguments.model = shipped("urdf/slider_crank.urdf");
  arguments.study = folder.edited("study.yaml", read_text_file(shipped("config/slider_crank.yaml")),
                                  "duration: 2.0", "duration: 0.1");
  return load(arguments);
}

TEST(RunRecorder, RowsHoldTimeAndSignals) {
  const ScratchFolder folder;
  const Problem problem = short_problem(folder);
  Arguments arguments;
  arguments.signals = {"crank_joint/velocity", "crank_speed/error"};
  const std::vector<SignalDescription> signals = select_signals(arguments, problem);
  EXPECT_EQ(column_names(signals),
            (std::vector<std::string>{"time", "crank_joint/velocity", "crank_speed/error"}));
  std::vector<std::vector<double>> rows;
  const auto keep = [&rows](const std::vector<double>& row) { rows.push_back(row); };
  const RunSummary run = record_run(problem, problem.parameters(), signals, 5, keep);
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  EXPECT_GT(run.statistics.steps, 0);
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_NEAR(rows[k].at(0), 0.025 * static_cast<double>(k), 1e-15);
    EXPECT_NEAR(rows[k].at(2), -10.0 - rows[k].at(1), 1e-12);
  }
}

TEST(RunRecorder, ACancelledRunEndsAfterTheRowThatItIsAt) {
  const ScratchFolder folder;
  const Problem problem = short_problem(folder);
  for (int last : {0, 1, 3}) {
    std::atomic<bool> cancel{last == 0};
    int rows = 0;
    const auto count = [&](const std::vector<double>&) { cancel = ++rows == last; };
    EXPECT_EQ(record_run(problem, problem.parameters(), {}, 5, count, &cancel).status.code,
              StatusCode::kCancelled);
    EXPECT_EQ(rows, last);
  }
}

}  // namespace
}  // namespace codesign::cli
