// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "jobs/bag_files.h"
#include "mpi/run_on_ranks.h"

int main(int argc, char** argv) {
  namespace cli = codesign::cli;
  cli::watch_interrupts();
  return codesign::run_on_ranks("codesign", [&](codesign::Dispatcher* ranks) {
    const codesign::BagFiles bags = codesign::bag_files();
    return cli::run({argv + 1, argv + argc},
                    {std::cout, std::cerr, cli::interrupted(), cli::keep_results, ranks, bags.read,
                     bags.write_identification, bags.write_trajectory});
  });
}
