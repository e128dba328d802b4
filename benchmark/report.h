// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "benchmark/table.h"

namespace codesign {

/// A measured figure with its target.
struct Finding {
  std::string what;
  std::string unit;
  double measured;
  double target;
  bool at_least;  ///< whether the target is a lower bound
};

/// All tables and figures of a run of the benchmarks.
struct Report {
  std::vector<Table> tables;
  std::vector<Finding> findings;
};

// Each function measures one subject and adds its tables and findings. It throws std::runtime_error
// if a computation that must succeed fails.
void measure_kernels(Report* report);
/// Part of the one before: the programs that are derived, beside programs of what was written by
/// hand.
void measure_kernel_programs(Report* report);
void measure_steps(Report* report);
void measure_work_precision(Report* report);
void measure_parameters(Report* report);
void measure_optimization(Report* report);
void measure_stops(Report* report);
void measure_scaling(Report* report);
void measure_setup(Report* report);
void measure_planar(Report* report);
void measure_ensembles(Report* report);
/// Part of the one before: whether samples could share vector lanes.
void measure_lanes(Report* report);
void measure_identification(Report* report);
void measure_ranks(Report* report);
void measure_robots(Report* report);
void measure_simbody(Report* report);

}  // namespace codesign
