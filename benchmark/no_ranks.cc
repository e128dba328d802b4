// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// In place of rank_tables.cc and rank_program.cc where MPI is not installed.
#include <cstdio>

#include "benchmark/rank_program.h"
#include "benchmark/report.h"

namespace codesign {

void measure_ranks(Report*) {
  std::fprintf(
      stderr,
      "benchmarks: no MPI (libopenmpi-dev, openmpi-bin), so the tables of ranks are left out\n");
}

int run_rank_program(const std::string&) { return 2; }

}  // namespace codesign
