// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mechanism_codesign/simulation.h"

namespace codesign {

/// The signals of a run at one instant, with the parameters' start values.
inline std::vector<double> signals_at(const Problem& problem, double time,
                                      const std::vector<std::string>& signals) {
  Simulation simulation(problem, problem.parameters(), signals);
  EXPECT_TRUE(simulation.start().ok());
  const Status status = simulation.advance_to(time);
  EXPECT_TRUE(status.ok()) << status.cause;
  Frame frame;
  simulation.sample(time, &frame);
  return frame.signals;
}

}  // namespace codesign
