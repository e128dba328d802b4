// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "cli/commands.h"
#include "cli/interrupt.h"

int main(int argc, char** argv) {
  codesign::cli::watch_interrupts();
  return codesign::cli::run({argv + 1, argv + argc}, {std::cout, std::cerr, codesign::cli::interrupted(), codesign::cli::keep_results,
                                                      codesign::linked_bag_reader()});
}
