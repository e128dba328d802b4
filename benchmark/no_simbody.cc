// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "benchmark/report.h"
#include "benchmark/robot_peers.h"

namespace codesign {

void measure_simbody(Report*) {
  std::fprintf(stderr,
               "Simbody is not installed (tools/setup --benchmark): its table is left out\n");
}

std::optional<RobotMotion> run_simbody_robot(const Robot&, double) { return std::nullopt; }

}  // namespace codesign
